// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_file.hpp"

#include "scenario/document/json.hpp"

#include <zlib.h>

#include <bit>
#include <stdexcept>

namespace rovernet {
namespace {

static_assert(std::endian::native == std::endian::little, "columns are copied as they are");

/// Compresses bytes by DEFLATE, without a header (RFC 1951).
std::string deflated(std::string_view bytes) {
    constexpr int level = 6, raw = -15, memory = 8;  // zlib's defaults; raw: no header
    z_stream stream{};
    if (deflateInit2(&stream, level, Z_DEFLATED, raw, memory, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("zlib: no memory");
    std::string out(deflateBound(&stream, bytes.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    deflate(&stream, Z_FINISH);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

void append(std::string& out, std::uint32_t number) {
    out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace

void ViewFile::add(const std::string& name, std::string_view type, std::size_t count,
                   std::string_view bytes) {
    const std::string packed = packs_ ? deflated(bytes) : std::string(bytes);
    Table section;
    section.set("name", name);
    section.set("type", type);
    section.set("count", std::uint64_t{count});
    section.set("offset", std::uint64_t{data_.size()});
    section.set("bytes", std::uint64_t{packed.size()});
    if (!packs_) section.set("raw", true);
    sections_.emplace_back(std::move(section));
    data_ += packed;
}

void ViewFile::add_indices(const std::string& name, std::span<const std::uint32_t> indices,
                           std::size_t size) {
    if (size >= 65'535) return add(name, indices);
    // no_index is the largest number of both types.
    std::vector<std::uint16_t> narrow;
    narrow.reserve(indices.size());
    for (const std::uint32_t index : indices) narrow.push_back(static_cast<std::uint16_t>(index));
    add(name, narrow);
}

void ViewFile::add_times(const std::string& name, std::span<const std::int64_t> times) {
    std::vector<std::uint32_t> words(2 * times.size());
    std::int64_t before = 0;
    for (std::size_t i = 0; i < times.size(); ++i) {
        const auto step = static_cast<std::uint64_t>(times[i] - before);
        words[i] = static_cast<std::uint32_t>(step);
        words[times.size() + i] = static_cast<std::uint32_t>(step >> 32U);
        before = times[i];
    }
    add(name, "time", times.size(),
        {reinterpret_cast<const char*>(words.data()), words.size() * sizeof words[0]});
}

void ViewFile::add_texts(const std::string& name, std::span<const std::string> texts) {
    std::string bytes;
    std::uint32_t offset = 0;
    append(bytes, offset);
    for (const std::string& text : texts)
        append(bytes, offset += static_cast<std::uint32_t>(text.size()));
    for (const std::string& text : texts) bytes += text;
    add(name, "text", texts.size(), bytes);
}

std::string ViewFile::bytes(Table head) const {
    head.set("sections", sections_);
    std::string json = to_json_line(std::move(head));
    json.resize((json.size() + 7) / 8 * 8, ' ');
    std::string out = "RVW1";
    append(out, static_cast<std::uint32_t>(json.size()));
    return out + json + data_;
}

}  // namespace rovernet
