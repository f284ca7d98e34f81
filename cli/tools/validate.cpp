// SPDX-License-Identifier: MIT
#include "cli/terminal/diagnostics.hpp"
#include "cli/terminal/stop.hpp"
#include "cli/terminal/text_table.hpp"
#include "cli/tools/tool_commands.hpp"
#include "experiment/output.hpp"
#include "study/validation/headline.hpp"
#include "study/validation/validation.hpp"
#include "study/validation/validation_report.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

namespace rovernet::cli {
namespace {

void write_report(const std::string& folder, const Validation& validation) {
    make_folder(folder);
    std::vector<OutputFile> files{{folder + "/report.html", validation_html(validation)},
                                  {folder + "/accuracy.md", accuracy_page(validation)},
                                  {folder + "/promises.md", promises_page(validation)},
                                  {folder + "/headline.svg", headline_svg(validation)}};
    for (const ValidationChart& chart : validation.charts) {
        files.push_back({folder + "/" + chart.name + ".svg", validation_svg(chart)});
        files.push_back({folder + "/" + chart.name + ".csv", validation_csv(chart)});
    }
    write_whole(files);
}

void print_validation(const Validation& validation) {
    for (const ValidationChart& chart : validation.charts) {
        fmt::print("{}\n", chart.title);
        for (const std::string& sentence : chart.sentences) fmt::print("  {}\n", sentence);
    }
    fmt::print("\n");
    TextTable table({"promise", "limit", "worst case", "kept"});
    for (const Promise& p : validation.promises) {
        const std::string unit = p.unit.empty() ? "" : " " + p.unit;
        table.add({p.what, fmt::format("{:g}{}", p.limit, unit),
                   fmt::format("{:.2g}{}", p.worst, unit), p.kept() ? "yes" : "NO"});
    }
    fmt::print("{}", table.text());
}

}  // namespace

void validate(const ValidateArguments& a) {
    const Validation validation = rovernet::validate({.quick = a.quick}, a.field,
                                                     [](std::string_view what) { detail(what); });
    write_report(a.out, validation);
    print_validation(validation);
    for (const std::string& text : validation.left_out) notice("left out: " + text);
    if (!validation.kept())
        throw CommandEnd(failed,
                         "an error exceeds the limit that the code promises: see the rows of the "
                         "table with NO in the column \"kept\"");
}

}  // namespace rovernet::cli
