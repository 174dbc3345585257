#include "net/mail.h"

#include "net/guard.h"

namespace froxel::net {

Mail::~Mail() {
    for (auto& letter : letters_) {
        // Only memory can fail; the viewer misses this one.
        static_cast<void>(guarded("mail", [&] { letter.first->tell(std::move(letter.second)); }));
    }
}

void Mail::add(const std::weak_ptr<SessionViewer>& viewer, Notice notice) {
    if (auto present = viewer.lock()) {
        letters_.emplace_back(std::move(present), std::move(notice));
    }
}

} // namespace froxel::net
