// SPDX-License-Identifier: MIT
#include "traces/recorded/bytes.hpp"

#include <cstring>

namespace rovernet {

void ByteWriter::bytes(std::string_view text) {
    if (text.empty()) return;
    std::memcpy(room(text.size()), text.data(), text.size());
    used_ += text.size();
}

std::uint64_t ByteReader::varint() {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < rest_.size() && i < longest_varint; ++i) {
        const auto byte = static_cast<unsigned char>(rest_[i]);
        value |= std::uint64_t{byte & 0x7fU} << (7 * i);
        if (byte >= 0x80) continue;
        rest_.remove_prefix(i + 1);
        if (i + 1 == longest_varint && byte > 1) fail();  // more than 64 bits
        return failed_ ? 0 : value;
    }
    fail();
    return 0;
}

std::string_view ByteReader::take(std::uint64_t size) {
    if (size > rest_.size()) {
        fail();
        return {};
    }
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
}

}  // namespace rovernet
