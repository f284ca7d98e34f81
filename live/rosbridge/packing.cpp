// SPDX-License-Identifier: MIT
#include "live/rosbridge/packing.hpp"

#include "live/rosbridge/writer.hpp"
#include "scene/images/png.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace rovernet {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 20U;  // of pieces
constexpr std::size_t most_messages = 16;                  // that are not whole
constexpr Duration whole_within = std::chrono::seconds(10);

/// Length of the part of a text that has at most so many bytes and ends with a character's end.
std::size_t length_of_part(std::string_view text, std::size_t size) {
    if (text.size() <= size) return text.size();
    while (size > 1 && (static_cast<unsigned char>(text[size]) & 0xc0U) == 0x80U) --size;
    return size;
}

}  // namespace

std::string in_picture(std::string_view message) {
    constexpr std::size_t channels = 3;
    const std::size_t pixels = (message.size() + channels - 1) / channels;
    const auto width = static_cast<std::size_t>(
        std::max(1.0, std::floor(std::sqrt(static_cast<double>(message.size()) / channels))));
    const std::size_t height = (pixels + width - 1) / width;
    Image image{static_cast<int>(width), static_cast<int>(height), channels, {}};
    image.samples.assign(message.begin(), message.end());
    image.samples.resize(width * height * channels, '\n');
    std::string text;
    RosJsonWriter out(text);
    out.open_object();
    out.key("op");
    out.text("png");
    out.key("data");
    out.bytes(to_png(image));
    out.close_object();
    return text;
}

void send_in_pieces(std::string_view message, std::size_t size, const std::string& id,
                    const std::function<void(std::string_view)>& send) {
    std::vector<std::string_view> pieces;
    while (!message.empty()) {
        pieces.push_back(message.substr(0, length_of_part(message, size)));
        message.remove_prefix(pieces.back().size());
    }
    std::string text;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        text.clear();
        RosJsonWriter out(text);
        out.open_object();
        out.key("op");
        out.text("fragment");
        out.key("id");
        out.text(id);
        out.key("data");
        out.text(pieces[i]);
        out.key("num");
        out.whole(static_cast<std::int64_t>(i));
        out.key("total");
        out.whole(static_cast<std::int64_t>(pieces.size()));
        out.close_object();
        send(text);
    }
}

std::size_t RosPieces::bytes() const {
    std::size_t sum = 0;
    for (const auto& [id, message] : messages_) {
        for (const auto& [number, piece] : message.pieces) sum += piece.size();
    }
    return sum;
}

std::optional<std::string> RosPieces::add(const std::string& id, RosFragment piece, Time now) {
    std::erase_if(messages_,
                  [&](const auto& each) { return now - each.second.since > whole_within; });
    Message& message = messages_.try_emplace(id, Message{now, {}}).first->second;
    message.pieces[piece.number] = std::move(piece.data);
    if (messages_.size() > most_messages || bytes() > most_bytes) {
        messages_.erase(id);
        throw RequestError("too_many", "",
                           "pieces that are not whole: expected 16 messages and 1 MiB at most");
    }
    if (message.pieces.size() < piece.total) return std::nullopt;
    std::string whole;
    for (const auto& [number, data] : message.pieces) whole += data;
    messages_.erase(id);
    return whole;
}

}  // namespace rovernet
