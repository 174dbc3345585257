// In place of basis_transcoder.cpp in a build without npm's packages.
#include "ktx2/basis_transcoder.h"

namespace froxel::ktx2 {

Result<void> transcodeBasis(std::span<const std::byte> /*file*/,
                            std::span<const std::span<std::byte>> /*levels*/) {
    return Error{ErrorCode::kUnsupported,
                 "it is ETC1S or UASTC, which a build with FROXEL_BASIS=OFF does not read"};
}

} // namespace froxel::ktx2
