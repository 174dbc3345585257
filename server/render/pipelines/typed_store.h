// Objects that not everybody needs, one of a type.
#pragma once

#include <map>
#include <memory>
#include <typeindex>
#include <utility>

namespace froxel::render {

class TypedStore {
  public:
    // Made from `args` at the first call; what that throws leaves none.
    template <class T, class... Args>
    [[nodiscard]] T& findOrMake(Args&&... args) {
        auto& made = made_[typeid(T)];
        if (!made) {
            made = std::make_shared<T>(std::forward<Args>(args)...);
        }
        return *static_cast<T*>(made.get());
    }
    // Null: it was not made.
    template <class T>
    [[nodiscard]] T* find() const {
        const auto at = made_.find(typeid(T));
        return at != made_.end() ? static_cast<T*>(at->second.get()) : nullptr;
    }
    // It was made.
    template <class T>
    [[nodiscard]] T& get() const {
        return *static_cast<T*>(made_.at(typeid(T)).get());
    }

  private:
    std::map<std::type_index, std::shared_ptr<void>> made_;
};

} // namespace froxel::render
