#include "frep/base/result.h"

#include <cstdio>
#include <cstdlib>

namespace frep {

void check_failed(const char* condition, const char* file, int line) {
    std::fprintf(stderr, "internal error: %s (%s:%d)\n", condition, file, line);
    std::abort();
}

}  // namespace frep
