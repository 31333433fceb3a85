// Which drawing formats there are; the encoders are in write_svg.cpp and write_dxf.cpp.
#include "frep/io/drawing_format.h"

namespace frep {

Result<DrawingFormat> drawing_format_from_path(std::string_view) {
    return Error{ErrorKind::invalid_argument, "drawings are not written yet"};
}

Result<std::string> encode_drawing(const std::vector<Polyline>&, DrawingFormat, const DrawingOptions&) {
    return Error{ErrorKind::invalid_argument, "drawings are not written yet"};
}

}  // namespace frep
