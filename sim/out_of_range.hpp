// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace rovernet {

/// Error of a parameter that is out of its range or not set. Readers of files report it at the file
/// position of the parameter's key.
class OutOfRange : public std::invalid_argument {
  public:
    /// @param parameter  key of the parameter
    /// @param message    "OWNER: NAME must be RANGE, got VALUE"
    OutOfRange(std::string_view parameter, const std::string& message)
        : std::invalid_argument(message), parameter_(parameter) {}

    const std::string& parameter() const { return parameter_; }

  private:
    std::string parameter_;
};

}  // namespace rovernet
