// Values for settings, drawn over the whole of what a server takes, with its ends often.
#pragma once

#include "froxel/v1/server.pb.h"

#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <utility>

namespace froxel::load {

// One viewer's; the same in every run. Not for several threads.
class RandomValues {
  public:
    // Ranges and the scene's bounds are Welcome's.
    RandomValues(const v1::Welcome& welcome, uint32_t seed);

    // Both ends included.
    [[nodiscard]] uint32_t whole(uint32_t from, uint32_t to);
    [[nodiscard]] double real(double from, double to);
    // True once in so many times.
    [[nodiscard]] bool once(uint32_t in) { return whole(1, in) == 1; }
    // Of a FieldRange: an end of it in a third of the cases. 0 where the server told no such range.
    [[nodiscard]] double within(std::string_view range);
    // Each of three numbers.
    [[nodiscard]] v1::Vec3 vecWithin(std::string_view range);
    // Where lights are; rarely anywhere at all.
    [[nodiscard]] v1::Vec3 place();

    enum class Fields : uint8_t { kAll, kSome };
    // Switches, names and numbers that keep to a range, and messages of such; kSome leaves out half
    // of those that may be absent.
    void fill(google::protobuf::Message& message, Fields which);

  private:
    void fillMessage(google::protobuf::Message& message,
                     const google::protobuf::FieldDescriptor& field,
                     Fields which);
    void fillNumber(google::protobuf::Message& message,
                    const google::protobuf::FieldDescriptor& field);
    void fillName(google::protobuf::Message& message,
                  const google::protobuf::FieldDescriptor& field);

    std::map<std::string, std::pair<double, double>, std::less<>> ranges_; // least and most
    v1::Box box_;
    std::mt19937 random_;
};

} // namespace froxel::load
