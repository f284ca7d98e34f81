// SPDX-License-Identifier: MIT
#pragma once

#include "scene/images/image.hpp"
#include "sim/error.hpp"
#include "test/scene/temporary_folder.hpp"

#include <string>

namespace rovernet::test {

/// Picture of a file with these bytes.
inline Image read_bytes(const std::string& bytes) {
    const TemporaryFolder folder;
    return read_image(folder.write("image", bytes));
}

/// Message of the error that reading these bytes ends in, without its place; "" if none.
inline std::string picture_error(const std::string& bytes) {
    try {
        read_bytes(bytes);
    } catch (const InputError& error) {
        return error.message();
    }
    return "";
}

}  // namespace rovernet::test
