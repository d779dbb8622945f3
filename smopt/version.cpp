#include "smopt/version.h"

namespace smopt {

std::string_view version() { return SMOPT_VERSION; }

}  // namespace smopt
