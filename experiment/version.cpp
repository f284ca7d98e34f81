// SPDX-License-Identifier: MIT
#include "experiment/version.hpp"

#include "version_build.hpp"

namespace rovernet {

std::string_view version() { return build::version; }

Table build_provenance() {
    Table table;
    table.set("version", build::version);
    table.set("commit", build::commit);
    table.set("dirty", build::dirty);
    table.set("compiler", build::compiler);
    table.set("build_type", build::type);
    table.set("flags", build::flags);
    return table;
}

}  // namespace rovernet
