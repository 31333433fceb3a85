// Zip archives (PKWARE APPNOTE.TXT 6.3.9; the package format of OPC, ISO/IEC 29500-2), deflated by zlib
// (RFC 1951). The same entries give the same bytes with the same zlib: dates are 1980-01-01, the first that
// the format knows. Tested by tests/unit/io/zip_test.cpp.
#pragma once

#include <string>
#include <vector>

#include "frep/base/result.h"

namespace frep {

struct ZipEntry {
    std::string name;  ///< UTF-8, folders divided by /
    std::string bytes;
};

/// The entries, in their order, as an archive. Errors: over_limit for an entry or an archive of 4 GiB or more
/// or more than 65534 entries (zip64 is not written); invalid_argument for a name that is empty, used twice,
/// or longer than 65535 bytes.
Result<std::string> zip(const std::vector<ZipEntry>& entries);

}  // namespace frep
