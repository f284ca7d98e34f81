// SPDX-License-Identifier: MIT
#include "scene/images/image_reader.hpp"

#include <fmt/format.h>

namespace rovernet {
namespace {

class NetpbmReader {
  public:
    NetpbmReader(const std::string& path, std::FILE* file, char kind)
        : path_(path), file_(file), name_(names[(kind - '1') % 3]), plain_(kind <= '3') {}

    Image read() {
        const int width = number("a width", 1'000'000'000);
        const int height = number("a height", 1'000'000'000);
        Image image = sized_image(path_, width, height, name_ == "PPM" ? 3 : 1);
        if (name_ == "PBM") {
            read_bits(image);
            return image;
        }
        max_value_ = number("a maxval from 1 to 65535", 65535);
        if (max_value_ == 0)
            fail(
                fmt::format("found the maxval 0 (largest value of a sample) in {}; expected 1 to "
                            "65535; save the picture again",
                            name_));
        for (std::uint8_t& sample : image.samples)
            sample = scaled(plain_ ? number_sample() : raw());
        return image;
    }

  private:
    static constexpr const char* names[] = {"PBM", "PGM", "PPM"};

    int next() { return std::getc(file_); }

    [[noreturn]] void fail(const std::string& message) const { image_error(path_, message); }
    [[noreturn]] void truncated() const {
        fail(fmt::format("truncated {}; expected one {} per pixel; save the picture again", name_,
                         name_ == "PPM" ? "red, green and blue sample" : "sample"));
    }

    /// Next character; a comment is read as the end of its line.
    int next_outside_comment() {
        int c = next();
        if (c == '#')
            while (c != '\n' && c != '\r' && c != EOF) c = next();
        return c;
    }
    static bool white(int c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
    int next_not_white() {
        int c = next_outside_comment();
        while (white(c)) c = next_outside_comment();
        if (c == EOF) truncated();
        return c;
    }
    [[noreturn]] void unexpected(int c, const char* what) const {
        fail(fmt::format("found the byte 0x{:02x} in {}; expected {}; save the picture again", c,
                         name_, what));
    }

    /// Skips white space, then reads a decimal number and one white space after it.
    int number(const char* what, int limit) {
        int c = next_not_white();
        std::int64_t value = 0;
        bool digits = false;
        for (; c >= '0' && c <= '9'; c = next_outside_comment()) {
            digits = true;
            value = 10 * value + (c - '0');
            if (value > limit)
                fail(fmt::format(
                    "found a number above {} in {}; expected {}; save the picture again", limit,
                    name_, what));
        }
        if (!digits || !(white(c) || c == EOF)) unexpected(c, what);
        return static_cast<int>(value);
    }
    int number_sample() { return number("a sample up to the maxval", max_value_); }

    int byte() {
        const int c = next();
        if (c == EOF) truncated();
        return c;
    }
    /// Reads one byte, or two with the higher first if the maxval needs them.
    int raw() {
        const int high = max_value_ > 255 ? byte() : 0;
        const int value = 256 * high + byte();
        if (value > max_value_)
            fail(fmt::format(
                "found in the {} file a sample {}, which is above the maxval {} of the file's "
                "header; expected samples up to the maxval; save the picture again",
                name_, value, max_value_));
        return value;
    }
    std::uint8_t scaled(int value) const {
        return static_cast<std::uint8_t>((2 * 255 * value + max_value_) / (2 * max_value_));
    }

    /// Reads the pixels of a PBM: 1 is black. Plain pixels need no space between them; raw pixels
    /// are packed eight per byte, the leftmost in the highest bit, and each row begins at a byte.
    void read_bits(Image& image) {
        int bits = 0;
        for (std::size_t i = 0; i < image.samples.size(); ++i) {
            const std::size_t column = i % static_cast<std::size_t>(image.width);
            if (!plain_) bits = column % 8 == 0 ? byte() : bits << 1;
            const bool black = plain_ ? digit() : (bits & 0x80) != 0;
            image.samples[i] = black ? 0 : 255;
        }
    }
    bool digit() {
        const int c = next_not_white();
        if (c != '0' && c != '1') unexpected(c, "0 or 1");
        return c == '1';
    }

    const std::string& path_;
    std::FILE* file_;
    std::string_view name_;
    bool plain_;
    int max_value_ = 255;
};

}  // namespace

Image read_netpbm(const std::string& path, std::FILE* file, char kind) {
    return NetpbmReader(path, file, kind).read();
}

}  // namespace rovernet
