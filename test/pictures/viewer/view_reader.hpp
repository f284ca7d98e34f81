// SPDX-License-Identifier: MIT
#pragma once

#include "scenario/document/json.hpp"

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace rovernet::test {

/// Reader of view files for tests, written from docs/formats/view-format.md.
class ViewReader {
  public:
    explicit ViewReader(const std::string& bytes) {
        if (bytes.substr(0, 4) != "RVW1") throw std::runtime_error("no view file");
        std::uint32_t size = 0;
        std::memcpy(&size, bytes.data() + 4, 4);
        head_ = parse_json(bytes.substr(8, size));
        data_ = bytes.substr(8 + size);
    }

    const Table& head() const { return *head_.table(); }
    bool has(const std::string& name) const { return find(name) != nullptr; }
    /// Numbers of a column, which is unpacked once.
    const std::vector<double>& numbers(const std::string& name) const {
        const auto [at, is_new] = known_.try_emplace(name);
        if (is_new) at->second = read_numbers(name);
        return at->second;
    }
    std::vector<std::string> texts(const std::string& name) const {
        const std::string bytes = unpacked(need(name));
        const auto count = static_cast<std::size_t>(integer(need(name), "count"));
        const std::string offsets = bytes.substr(0, 4 * (count + 1));
        const std::vector<double> ends = as<std::uint32_t>(offsets);
        std::vector<std::string> out;
        for (std::size_t i = 0; i < count; ++i) {
            const auto from = static_cast<std::size_t>(ends[i]);
            out.push_back(
                bytes.substr(offsets.size() + from, static_cast<std::size_t>(ends[i + 1]) - from));
        }
        return out;
    }
    static std::int64_t integer(const Table& table, const char* key) {
        return std::get<std::int64_t>(table.find(key)->data);
    }

  private:
    std::vector<double> read_numbers(const std::string& name) const {
        const Table& section = need(name);
        const std::string type = *section.find("type")->string();
        const std::string bytes = unpacked(section);
        if (type == "u8") return as<std::uint8_t>(bytes);
        if (type == "u16") return as<std::uint16_t>(bytes);
        if (type == "u32") return as<std::uint32_t>(bytes);
        if (type == "f32") return as<float>(bytes);
        if (type == "f64") return as<double>(bytes);
        if (type != "time") throw std::runtime_error(name + ": no numbers");
        const std::vector<double> words = as<std::uint32_t>(bytes);
        std::vector<double> times(words.size() / 2);
        double t = 0;
        for (std::size_t i = 0; i < times.size(); ++i)
            times[i] = t += words[i] + 4294967296.0 * words[times.size() + i];
        return times;
    }
    template <class T>
    static std::vector<double> as(const std::string& bytes) {
        std::vector<T> numbers(bytes.size() / sizeof(T));
        if (!bytes.empty()) std::memcpy(numbers.data(), bytes.data(), bytes.size());
        return {numbers.begin(), numbers.end()};
    }
    const Table* find(const std::string& name) const {
        for (const Value& each : *head().find("sections")->array())
            if (*each.table()->find("name")->string() == name) return each.table();
        return nullptr;
    }
    const Table& need(const std::string& name) const {
        if (const Table* section = find(name)) return *section;
        throw std::runtime_error(name + " is missing");
    }
    std::string unpacked(const Table& section) const {
        const auto at = static_cast<std::size_t>(integer(section, "offset"));
        std::string packed = data_.substr(at, static_cast<std::size_t>(integer(section, "bytes")));
        if (section.find("raw")) return packed;
        std::string out;
        z_stream stream{};
        inflateInit2(&stream, -15);
        stream.next_in = reinterpret_cast<Bytef*>(packed.data());
        stream.avail_in = static_cast<uInt>(packed.size());
        int end = Z_OK;
        while (end == Z_OK) {
            constexpr std::size_t part = 65'536;
            out.resize(stream.total_out + part);
            stream.next_out = reinterpret_cast<Bytef*>(out.data() + stream.total_out);
            stream.avail_out = part;
            end = inflate(&stream, Z_NO_FLUSH);
        }
        out.resize(stream.total_out);
        inflateEnd(&stream);
        if (end != Z_STREAM_END) throw std::runtime_error("a section is broken");
        return out;
    }

    Value head_;
    std::string data_;
    mutable std::map<std::string, std::vector<double>> known_;
};

}  // namespace rovernet::test
