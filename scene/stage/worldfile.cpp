// SPDX-License-Identifier: MIT
#include "scene/stage/worldfile.hpp"

#include "scene/stage/world_model.hpp"
#include "scene/stage/world_tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <map>
#include <set>

namespace rovernet {
namespace {

using Kind = WorldToken::Kind;

constexpr int deepest = 64;

/// Parser of tokens to entities. The tokens of a macro are parsed again at each use.
class Parser {
  public:
    explicit Parser(const WorldTokens& tokens) : tokens_(tokens) {}

    void parse(WorldFile& out) {
        std::size_t at = 0;
        out.root.where = Location{tokens_.files.front()};
        body(at, out.root, 0, nullptr);
        out.notices.insert(out.notices.end(), notices_.begin(), notices_.end());
    }

  private:
    struct Macro {
        std::string base;
        std::size_t body;  // of the token after its "("
        Location where;
    };

    const WorldToken& token(std::size_t at) const { return tokens_.tokens[at]; }
    Location where(const WorldToken& token) const { return tokens_.where(token); }
    [[noreturn]] void fail(const WorldToken& at, const std::string& message) const {
        throw InputError(where(at), message);
    }
    void note(const Location& place, const std::string& text);

    const WorldToken& take(std::size_t& at);
    void skip_line_ends(std::size_t& at);
    void body(std::size_t& at, WorldEntity& into, int depth, const WorldToken* opened);
    void statement(std::size_t& at, const WorldToken& name, WorldEntity& into, int depth);
    void property(std::size_t& at, WorldEntity& into, const WorldToken& name);
    void tuple(std::size_t& at, WorldProperty& into);
    double number(const WorldToken& token);
    void define(std::size_t& at, int depth);
    WorldEntity entity(std::size_t& at, const WorldToken& type, int depth);
    void start(WorldEntity& entity, const std::string& type, const WorldToken& use, int depth);
    void note_unknown_type(const WorldEntity& entity);
    [[noreturn]] void reject_value(const WorldToken& name, const WorldToken& found) const;

    const WorldTokens& tokens_;
    std::map<std::string, Macro, std::less<>> macros_;
    std::vector<std::string> notices_;
    std::set<std::string> noted_;
    std::set<std::string> unknown_types_;
    std::size_t taken_ = 0;
    bool checking_ = false;  // in a define: the body is looked at and thrown away
};

void Parser::note(const Location& place, const std::string& text) {
    std::string notice = world_notice(place, text);
    if (noted_.insert(notice).second) notices_.push_back(std::move(notice));
}

/// Counts the tokens of the file and of its expanded macros.
const WorldToken& Parser::take(std::size_t& at) {
    const WorldToken& taken = token(at);
    if (taken.kind != Kind::file_end) ++at;
    constexpr std::size_t most = 2 * most_world_tokens;  // each is also looked at in its macro
    if (++taken_ > most) {
        fail(taken, fmt::format("the expanded macros have more than {} words, values and lines; "
                                "expected fewer; do macros use each other many times?",
                                most_world_tokens));
    }
    return taken;
}

void Parser::skip_line_ends(std::size_t& at) {
    while (token(at).kind == Kind::line_end) take(at);
}

/// Parses the statements up to the ")" of `opened`, or to the end of the file if it is null.
void Parser::body(std::size_t& at, WorldEntity& into, int depth, const WorldToken* opened) {
    for (;;) {
        const WorldToken& next = take(at);
        if (next.kind == Kind::line_end) continue;
        if (next.kind == Kind::word) {
            statement(at, next, into, depth);
        } else if (next.kind == Kind::close && opened) {
            return;
        } else if (next.kind == Kind::file_end && !opened) {
            return;
        } else if (next.kind == Kind::close) {
            fail(next,
                 "found \")\" without a \"(\"; expected a key, a model or the end of the file; "
                 "remove the \")\"");
        } else if (next.kind == Kind::file_end) {
            fail(next, fmt::format("found the end of the file; expected the \")\" that closes the "
                                   "\"(\" at {}; add the \")\"",
                                   where(*opened).text()));
        } else {
            fail(next, fmt::format("found {}; expected a key or the type of a model; write \"name "
                                   "value\" or \"type ( ... )\"",
                                   next.description()));
        }
    }
}

void Parser::statement(std::size_t& at, const WorldToken& name, WorldEntity& into, int depth) {
    if (name.text == "define") return define(at, depth);
    const Kind next = token(at).kind;
    if (next == Kind::number || next == Kind::text || next == Kind::open_tuple) {
        return property(at, into, name);
    }
    const WorldToken& found = token(at);
    skip_line_ends(at);
    if (token(at).kind != Kind::open) reject_value(name, found);
    into.children.push_back(entity(at, name, depth));
}

void Parser::reject_value(const WorldToken& name, const WorldToken& found) const {
    const std::string expected = fmt::format(
        "expected the value of \"{}\" on the same line: a number, a text in quotes or [values]; or "
        "a \"(\" that begins a block",
        name.text);
    const std::string suggestion =
        found.kind == Kind::word ? fmt::format("did you mean \"{}\", in quotes?", found.text)
                                 : fmt::format("write {} 1, or {} ( ... )", name.text, name.text);
    fail(found, fmt::format("found {}; {}; {}", found.description(), expected, suggestion));
}

void Parser::property(std::size_t& at, WorldEntity& into, const WorldToken& name) {
    WorldProperty property{.name = name.text, .values = {}, .where = where(name)};
    const WorldToken& value = take(at);
    if (value.kind == Kind::open_tuple) {
        tuple(at, property);
    } else if (value.kind == Kind::number) {
        property.values.emplace_back(number(value));
    } else {
        property.values.emplace_back(value.text);
    }
    if (!checking_) into.properties.push_back(std::move(property));
}

void Parser::tuple(std::size_t& at, WorldProperty& into) {
    into.is_tuple = true;
    for (;;) {
        const WorldToken& value = take(at);
        if (value.kind == Kind::close_tuple) return;
        if (value.kind == Kind::line_end) continue;
        if (value.kind == Kind::number) {
            into.values.emplace_back(number(value));
        } else if (value.kind == Kind::text) {
            into.values.emplace_back(value.text);
        } else {
            fail(value, fmt::format("found {} inside the [ ] of \"{}\"; expected numbers or texts, "
                                    "and then the \"]\"; {}",
                                    value.description(), into.name,
                                    value.kind == Kind::word && value.line == into.where.line
                                        ? "put a text in quotes"
                                        : "add the \"]\""));
        }
    }
}

/// Value of a number, with a notice if it is followed by ignored characters.
double Parser::number(const WorldToken& token) {
    if (token.is_cut) {
        note(where(token),
             fmt::format(
                 "\"{}\" is read as {}, as in Stage; the characters after this number are ignored",
                 token.text, token.number));
    }
    return token.number;
}

void Parser::define(std::size_t& at, int depth) {
    const WorldToken& name = take(at);
    const WorldToken& base = name.kind == Kind::word ? take(at) : name;
    if (base.kind != Kind::word) {
        fail(base, fmt::format("found {}; expected the macro's name and its type; write define "
                               "robot position ( ... )",
                               base.description()));
    }
    skip_line_ends(at);
    const WorldToken& open = take(at);
    if (open.kind != Kind::open) {
        fail(open, fmt::format("found {}; expected \"(\" after \"define {} {}\"; write define {} "
                               "{} ( ... )",
                               open.description(), name.text, base.text, name.text, base.text));
    }
    const Macro macro{base.text, at, where(name)};
    const bool was_checking = std::exchange(checking_, true);
    WorldEntity ignored;
    body(at, ignored, depth + 1, &open);
    checking_ = was_checking;
    if (checking_)
        fail(name,
             "found a \"define\" inside a \"define\"; move the inner \"define\" out of the outer "
             "\"define\"");
    const auto [first, is_new] = macros_.try_emplace(name.text, macro);
    if (!is_new && first->second.where.text() != macro.where.text()) {
        note(macro.where, fmt::format("macro \"{}\" is defined a second time; the first "
                                      "definition, at {}, is used",
                                      name.text, first->second.where.text()));
    }
}

WorldEntity Parser::entity(std::size_t& at, const WorldToken& type, int depth) {
    const WorldToken& open = take(at);
    WorldEntity made;
    made.where = where(type);
    start(made, type.text, type, depth + 1);
    if (made.type != type.text) made.macro = type.text;
    body(at, made, depth + 1, &open);
    if (!checking_) note_unknown_type(made);
    return made;
}

/// Fills an entity with the content of its macro, if its type is a macro.
void Parser::start(WorldEntity& entity, const std::string& type, const WorldToken& use, int depth) {
    if (depth > deepest) {
        fail(use, fmt::format("\"{}\" is nested more than {} levels deep; expected fewer levels; "
                              "does a macro use itself?",
                              use.text, deepest));
    }
    const auto macro = checking_ ? macros_.end() : macros_.find(type);
    if (macro == macros_.end()) {
        entity.type = type;
        return;
    }
    start(entity, macro->second.base, use, depth + 1);
    std::size_t at = macro->second.body;
    body(at, entity, depth, &token(at - 1));
}

void Parser::note_unknown_type(const WorldEntity& entity) {
    const auto& types = stage_types();
    if (std::find(types.begin(), types.end(), entity.type) != types.end()) return;
    if (!unknown_types_.insert(entity.type).second) return;
    std::vector<std::string> candidates = types;
    constexpr std::size_t enough = 200;
    for (const auto& [name, macro] : macros_) {
        if (candidates.size() < enough) candidates.push_back(name);
    }
    const bool many = unknown_types_.size() > enough;
    const std::string near = many ? "" : did_you_mean(entity.type, candidates);
    const WorldRole role = world_role(entity);
    const char* fate =
        role == WorldRole::robot
            ? "this entry is treated as if its type were position, because it contains a wifi model"
        : role == WorldRole::wall
            ? "this entry is treated as if its type were model, because it has a bitmap"
            : "this entry is ignored";
    note(entity.where,
         fmt::format("unknown type \"{}\", and there is no macro of this name; {}{}{}", entity.type,
                     fate, near.empty() ? "" : "; ", near));
}

/// Whether a text is a number and nothing else.
bool reads_as_number(const std::string& text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc{} && stop == end;
}

}  // namespace

const WorldProperty* WorldEntity::find(std::string_view name) const {
    const auto found =
        std::find_if(properties.rbegin(), properties.rend(),
                     [&](const WorldProperty& property) { return property.name == name; });
    return found == properties.rend() ? nullptr : &*found;
}

double WorldProperty::number() const {
    const double* value =
        values.size() == 1 && !is_tuple ? std::get_if<double>(&values[0]) : nullptr;
    if (value) return *value;
    // A number in quotes is repeated without them.
    const auto* quoted =
        values.size() == 1 && !is_tuple ? std::get_if<std::string>(&values[0]) : nullptr;
    const bool is_number = quoted && reads_as_number(*quoted);
    throw InputError(where,
                     fmt::format("{}: found {}; expected one number; write {} {}", name,
                                 is_tuple ? "a list" : "a text", name, is_number ? *quoted : "1"));
}

const std::string& WorldProperty::text() const {
    const auto* value =
        values.size() == 1 && !is_tuple ? std::get_if<std::string>(&values[0]) : nullptr;
    if (value) return *value;
    throw InputError(where, fmt::format("{}: found {}; expected a text in quotes; write {} \"...\"",
                                        name, is_tuple ? "a list" : "a number", name));
}

WorldFile read_worldfile(const std::string& path, const WorldOptions& options) {
    const WorldTokens tokens = read_world_tokens(path, options);
    WorldFile out{.path = path, .root = {}, .notices = tokens.notices};
    Parser(tokens).parse(out);
    return out;
}

std::string world_notice(const Location& where, std::string_view text) {
    return where.line > 0 ? fmt::format("{}:{}: {}", where.source, where.line, text)
                          : fmt::format("{}: {}", where.source, text);
}

}  // namespace rovernet
