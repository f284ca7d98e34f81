// SPDX-License-Identifier: MIT
#include "mobility/files/movement_file.hpp"

#include "files/text_source.hpp"
#include "files/word.hpp"
#include "mobility/files/bonnmotion.hpp"
#include "mobility/files/fcd.hpp"
#include "mobility/files/movement_reader.hpp"
#include "mobility/files/setdest.hpp"

#include <fmt/format.h>

namespace rovernet {
namespace {

/// First byte that is neither blank nor in a comment, and its place; 0 if there is none.
struct FirstByte {
    char byte = 0;
    Location where;
    bool comment = false;  ///< there was a comment before it
};

FirstByte first_byte(TextSource& source) {
    FirstByte first{.where = {.source = source.name(), .line = 1, .column = 1}};
    bool in_comment = false;
    while (!source.window().empty() || source.more()) {
        const std::string_view text = source.window();
        for (const char c : text) {
            if (c == '\n') {
                ++first.where.line;
                first.where.column = 0;
                in_comment = false;
            } else if (c == '#') {
                in_comment = first.comment = true;
            } else if (!in_comment && c != ' ' && c != '\t' && c != '\r') {
                first.byte = c;
                return first;
            }
            ++first.where.column;
        }
        source.take(text.size());
    }
    return first;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool begins_number(char c) { return (c >= '0' && c <= '9') || c == '-' || c == '+' || c == '.'; }

std::unique_ptr<MovementFile::Reader> reader_of(const std::string& path, MovementSyntax syntax) {
    constexpr std::string_view kinds =
        "a movement file: of ns-2 (setdest), of BonnMotion (.movements) or of SUMO (FCD, XML)";
    TextSource source(path);
    const FirstByte first = first_byte(source);
    source.rewind();
    if (first.byte == '<') return read_fcd(std::move(source), syntax);
    if (begins_number(first.byte)) return read_bonnmotion(std::move(source));
    if (is_letter(first.byte) || first.byte == '$' || (first.byte == 0 && first.comment)) {
        return read_setdest(std::move(source), syntax);
    }
    if (first.byte == 0)
        throw InputError({.source = path}, fmt::format("the file is empty, expected {}", kinds));
    fail_at(first.where, {{&first.byte, 1}, first.where.column}, kinds);
}

}  // namespace

std::string kept_notice(const std::string& file, std::uint64_t legs) {
    return fmt::format(
        "{} is not sorted by time, so {} leg{} of the robots' paths {} kept in memory", file, legs,
        legs == 1 ? "" : "s", legs == 1 ? "is" : "are");
}

void fail_changed(const std::string& file) {
    throw InputError({.source = file},
                     "another program changed this file while it was read; run the command again");
}

MovementFile::MovementFile(const std::string& path, MovementSyntax syntax)
    : reader_(reader_of(path, syntax)) {
    if (reader_->end_where.source.empty()) reader_->end_where.source = path;
}
MovementFile::~MovementFile() = default;
MovementFile::MovementFile(MovementFile&&) noexcept = default;
MovementFile& MovementFile::operator=(MovementFile&&) noexcept = default;

const std::vector<FileRobot>& MovementFile::robots() const { return reader_->robots; }
const std::vector<std::string>& MovementFile::notices() const { return reader_->notices; }
Time MovementFile::end() const { return reader_->end; }
const Location& MovementFile::end_where() const { return reader_->end_where; }
std::optional<MovementCommand> MovementFile::next() { return reader_->next(); }

}  // namespace rovernet
