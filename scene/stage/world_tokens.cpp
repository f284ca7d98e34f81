// SPDX-License-Identifier: MIT
#include "scene/stage/world_tokens.hpp"

#include "files/input_file.hpp"
#include "files/kept_inputs.hpp"
#include "files/text_source.hpp"
#include "scene/stage/world_scanner.hpp"
#include "scene/stage/world_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ios>
#include <system_error>
#include <utility>

namespace rovernet {
namespace {

using Kind = WorldToken::Kind;

constexpr std::uintmax_t most_bytes_a_file = 16 << 20;
constexpr std::uintmax_t most_bytes = 64 << 20;
constexpr std::size_t deepest_include = 16;
constexpr std::size_t most_files = 10'000;

/// Reads files as tokens, with includes in place.
class Loader {
  public:
    Loader(const std::string& path, const WorldOptions& options)
        : search_(path, options), lenient_(options.lenient) {}

    WorldTokens load(const std::string& path) {
        add_file(path, Location{path});
        WorldToken end{.file = 0, .line = last_line_, .column = last_column_};
        out_.tokens.push_back(std::move(end));
        return std::move(out_);
    }

  private:
    std::string text_of(const std::string& path, const Location& where);
    void add_file(const std::string& path, const Location& where);
    void add(WorldToken token);
    void include(WorldScanner& scanner, const WorldToken& keyword);
    void enter(const std::string& path, const Location& where);

    WorldSearch search_;
    bool lenient_;
    WorldTokens out_;
    std::vector<std::string> open_;  // the files being read, outermost first, canonical
    std::uintmax_t bytes_ = 0;
    int last_line_ = 1;  // of the file that was ended last: in the end the top one
    int last_column_ = 1;
};

std::string Loader::text_of(const std::string& path, const Location& where) {
    const InputKind kind = input_kind(path);
    if (is_no_path(kind)) {
        throw InputError(where,
                         fmt::format("{}; expected a world file; check the path", fault_of(kind)));
    }
    if (kind != InputKind::file) {
        throw InputError(where, "is not a regular file; expected a world file; name a file");
    }
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        throw InputError(
            where, "cannot be opened; expected a readable file; check the permissions of the file");
    }
    note_input(path);
    std::error_code ignored;
    const std::uintmax_t size = std::filesystem::file_size(path, ignored);
    if (size > most_bytes_a_file || (bytes_ += size) > most_bytes) {
        throw InputError(where,
                         "is too large; expected at most 16 MiB in each file, and 64 MiB in the "
                         "world and its includes together; is this a world file?");
    }
    std::string text(static_cast<std::size_t>(size), '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    if (const std::string_view foreign = foreign_kind(text); !foreign.empty())
        throw InputError(where, fmt::format("{}; expected an uncompressed world file", foreign));
    return text;
}

void Loader::enter(const std::string& path, const Location& where) {
    std::error_code ignored;
    std::string canonical = std::filesystem::weakly_canonical(path, ignored).string();
    if (canonical.empty()) canonical = path;
    if (std::find(open_.begin(), open_.end(), canonical) != open_.end()) {
        throw InputError(where,
                         fmt::format("{} includes itself, directly or through other files; "
                                     "expected no circle of includes; remove one of the includes",
                                     path));
    }
    if (open_.size() > deepest_include) {
        throw InputError(where,
                         fmt::format("includes are nested more than {} levels deep; expected fewer "
                                     "levels; include this file directly in the world file",
                                     deepest_include));
    }
    if (out_.files.size() >= most_files) {
        throw InputError(where,
                         fmt::format("found more than {} includes; expected fewer", most_files));
    }
    open_.push_back(std::move(canonical));
}

void Loader::add_file(const std::string& path, const Location& where) {
    enter(path, where);
    const std::string text = text_of(path, where);
    out_.files.push_back(path);
    WorldScanner scanner(text, static_cast<int>(out_.files.size()) - 1, path);
    for (;;) {
        WorldToken token = scanner.next();
        if (token.kind == Kind::file_end) {
            last_line_ = token.line;
            last_column_ = token.column;
            token.kind = Kind::line_end;
            add(std::move(token));
            break;
        }
        if (token.kind == Kind::word && token.text == "include") {
            include(scanner, token);
        } else {
            add(std::move(token));
        }
    }
    open_.pop_back();
}

void Loader::add(WorldToken token) {
    if (out_.tokens.size() >= most_world_tokens) {
        throw InputError(
            out_.where(token),
            fmt::format(
                "found more than {} words, values and lines; expected fewer; is this a world file?",
                most_world_tokens));
    }
    out_.tokens.push_back(std::move(token));
}

void Loader::include(WorldScanner& scanner, const WorldToken& keyword) {
    const WorldToken name = scanner.next();
    if (name.kind != Kind::text || name.text.empty()) {
        throw InputError(out_.where(name),
                         fmt::format("found {}; expected the name of a file in quotes; write "
                                     "include \"map.inc\"",
                                     name.description()));
    }
    const WorldToken end = scanner.next();
    if (end.kind != Kind::line_end && end.kind != Kind::file_end) {
        throw InputError(out_.where(end),
                         fmt::format("found {}; expected nothing after an include; "
                                     "begin a new line",
                                     end.description()));
    }
    const WorldSearch::Result found = search_.find(name.text);
    const Location where = out_.where(name);
    if (found.path) return add_file(*found.path, where);
    if (!lenient_) {
        throw InputError(
            where, fmt::format("no file \"{}\" to include; tried the paths {}; give "
                               "the file's folder with --world-path or in the variable STAGEPATH",
                               name.text, found.places()));
    }
    out_.notices.push_back(fmt::format(
        "{}:{}: the include file \"{}\" is missing, so it is left out; tried the paths {}",
        where.source, keyword.line, name.text, found.places()));
}

}  // namespace

std::string WorldToken::description() const {
    constexpr std::size_t longest = 60;
    const std::string shown = text.size() > longest ? text.substr(0, longest) + "..." : text;
    switch (kind) {
        case Kind::word: return fmt::format("the word \"{}\"", shown);
        case Kind::number: return fmt::format("the number {}", shown);
        case Kind::text: return fmt::format("the text \"{}\"", shown);
        case Kind::line_end: return "the end of the line";
        case Kind::file_end: return "the end of the file";
        default: return fmt::format("\"{}\"", shown);
    }
}

WorldTokens read_world_tokens(const std::string& path, const WorldOptions& options) {
    return Loader(path, options).load(path);
}

}  // namespace rovernet
