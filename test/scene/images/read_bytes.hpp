// SPDX-License-Identifier: MIT
#pragma once

#include "scene/images/image.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <string>

namespace rovernet::test {

/// Image read from a file with these bytes.
inline Image read_bytes(const std::string& bytes) {
    const TemporaryFolder folder;
    return read_image(folder.write("image", bytes));
}

/// Message of the error when these bytes are read, without the file name; empty if there is no
/// error.
inline std::string picture_error(const std::string& bytes) {
    try {
        read_bytes(bytes);
    } catch (const InputError& error) {
        return error.message();
    }
    return "";
}

}  // namespace rovernet::test
