// SPDX-License-Identifier: MIT
#include "pictures/viewer/view_page.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace rovernet {
namespace {

/// Bytes in base64 (RFC 4648).
std::string base64(std::string_view bytes) {
    constexpr std::string_view letters =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return std::uint32_t{i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k])
                                                      : std::uint8_t{0}};
        };
        const std::uint32_t group = byte(0) << 16U | byte(1) << 8U | byte(2);
        for (const unsigned shift : {18U, 12U, 6U, 0U}) out += letters[group >> shift & 63U];
    }
    for (std::size_t i = bytes.size(); i % 3 != 0; ++i) out[out.size() - (3 - i % 3)] = '=';
    return out;
}

/// Policy of a page. @param connect  what the page may connect to
std::string policy(std::string_view connect) {
    return fmt::format("{}; connect-src {}", viewer_policy, connect);
}

/// The page with a policy about connections, and with data.
std::string page(std::string_view connect, std::string_view data) {
    std::string html(viewer_html);
    const auto put = [&](std::string_view mark, std::string_view text) {
        html.replace(html.find(mark), mark.size(), text);
    };
    put("<!--CSP-->", fmt::format("<meta http-equiv=\"Content-Security-Policy\" content=\"{}\">",
                                  policy(connect)));
    put("<!--DATA-->", data);
    return html;
}

/// Element of the page that contains a view file.
std::string element(std::string_view id, std::string_view view_file) {
    return fmt::format("<script type=\"application/octet-stream\" id=\"{}\">{}</script>", id,
                       base64(view_file));
}

}  // namespace

std::string page_with(std::string_view view_file, std::string_view other) {
    std::string data = element("run", view_file);
    if (!other.empty()) data += element("other", other);
    return page("'none'", data);
}

std::string served_page(bool has_other) {
    return page("'self'", has_other ? element("other", "") : "");
}
std::string served_policy() { return policy("'self'"); }
std::string live_page() { return page("'self'", "<i id=\"goes-on\" hidden></i>"); }

}  // namespace rovernet
