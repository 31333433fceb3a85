// Implementation of slice_format.h.
#include "frep/io/slice_format.h"

namespace frep {

Result<std::string> encode_slices(const std::vector<Slice>&, const SliceOptions&) {
    return Error{ErrorKind::invalid_argument, "slices are not written yet"};
}

}  // namespace frep
