// SPDX-License-Identifier: MIT
#include "scenario/reaction_table.hpp"

#include "scenario/tables/reader.hpp"

#include <fmt/format.h>

namespace rovernet {
namespace {

/// Checks the destination of a message: `to` needs `send`, and "sender" needs on_receive.
void check_receiver(const ReactionTable& reaction, TableReader& table) {
    if (!reaction.to) return;
    if (!reaction.send)
        table.missing("send", "send = \"F\"; the key \"to\" needs the key \"send\"");
    if (*reaction.to != ReactionTable::sender || reaction.trigger == Trigger::on_receive) return;
    throw InputError(
        reaction.to_where,
        fmt::format("to: found \"sender\" in the table {}, but only the table on_receive reacts to "
                    "a message that has a sender; expected the name of a robot",
                    name_of(reaction.trigger)));
}

Table reaction_document(const ReactionTable& reaction) {
    Table table;
    if (reaction.trigger == Trigger::on_receive) table.set("payload", reaction.payload);
    if (reaction.from) table.set("from", *reaction.from);
    if (reaction.hops) table.set("hops", *reaction.hops);
    if (reaction.trigger == Trigger::on_time) {
        table.set("time", to_value(reaction.time));
    } else {
        table.set("once", reaction.once);
    }
    if (reaction.move) table.set("move", move_document(*reaction.move));
    if (reaction.send) table.set("send", *reaction.send);
    if (reaction.to) table.set("to", *reaction.to);
    if (reaction.size) table.set("size", to_value(*reaction.size));
    if (reaction.stop) table.set("stop", true);
    return table;
}

}  // namespace

ReactionTable read_reaction(const Value& value, Trigger trigger) {
    TableReader table(value, std::string(name_of(trigger)));
    ReactionTable reaction;
    reaction.trigger = trigger;
    reaction.where = value.where;
    for_each_field<ReactionTable>([&](const auto& f) {
        if (ReactionTable::has_key(trigger, f.name)) table.take(f.name);
    });
    table.expect({"move"});
    for_each_field<ReactionTable>([&](const auto& f) {
        if (ReactionTable::has_key(trigger, f.name))
            table.read(f.name, reaction.*f.member, f.range);
    });
    if (const Value* move = table.take("move")) reaction.move = read_move(*move, true);
    if (reaction.from) reaction.from_where = table.take("from")->where;
    if (reaction.to) reaction.to_where = table.take("to")->where;
    if (trigger == Trigger::on_time && !table.table().find("time")) {
        table.missing("time", "time = \"10 s\"");
    }
    check_receiver(reaction, table);
    if (reaction.stop && reaction.move) table.only_one_of("move", "stop");
    if (reaction.size && !reaction.send)
        table.missing("send", "send = \"F\"; the key \"size\" needs the key \"send\"");
    if (!reaction.move && !reaction.send && !reaction.stop) {
        table.missing("move",
                      "move = { model = \"goal\", to = [...] }, send = \"F\" or stop = true");
    }
    return reaction;
}

void append_reactions(Table& table, const std::vector<ReactionTable>& reactions) {
    for (std::size_t i = 0; i < EnumNames<Trigger>::values.size(); ++i) {
        Array list;
        for (const ReactionTable& reaction : reactions) {
            if (reaction.trigger == static_cast<Trigger>(i)) {
                list.emplace_back(reaction_document(reaction));
            }
        }
        if (list.empty()) continue;
        const auto key = name_of(static_cast<Trigger>(i));
        if (list.size() == 1)
            table.set(key, std::move(list.front()));
        else
            table.set(key, std::move(list));
    }
}

}  // namespace rovernet
