// SPDX-License-Identifier: MIT
#include "cli/terminal/diagnostics.hpp"
#include "cli/tools/tool_commands.hpp"
#include "experiment/reports/loss_table.hpp"
#include "scenario/document/json.hpp"
#include "scenario/tables/read_value.hpp"
#include "scenario/unlikely.hpp"
#include "scene/materials/p2040.hpp"

#include <fmt/format.h>

#include <numbers>

namespace rovernet::cli {
namespace {

Location option(const std::string& name, const std::string& text) {
    return {name + " " + text, 0, 0, true};
}

ItuMaterial material_named(const std::string& name) {
    Value value{name};
    value.where = option("material", name);
    ItuMaterial material{};
    read_value(value, "material", material);
    return material;
}

Meters thickness_of(const std::string& text) {
    const Meters thickness = option_length("--thickness", text);
    if (thickness.value > 0) return thickness;
    throw InputError(option("--thickness", text), "expected a thickness > 0");
}

}  // namespace

void material(const MaterialArguments& a) {
    const ItuMaterial material = material_named(a.material);
    const Meters thickness = thickness_of(a.thickness);
    const Hertz frequency = option_frequency("--frequency", a.frequency);
    if (const std::string doubt = unlikely_frequency(frequency); !doubt.empty())
        notice("--" + doubt);
    const SlabLosses slab =
        slab_losses(material, thickness, frequency, Radians{a.angle * (std::numbers::pi / 180)});
    const Permittivity eps = permittivity(material, frequency);
    if (!a.json) {
        fmt::print(
            "{}, {:g} m thick, at {:g} GHz and {:g} degrees to the normal\n"
            "permittivity {:.4g} - {:.4g}j\n\n"
            "                      TE [dB]     TM [dB]\n"
            "transmission loss  {:>10.4f}  {:>10.4f}\n"
            "reflection loss    {:>10.4f}  {:>10.4f}\n",
            a.material, thickness.value, frequency.value / 1e9, a.angle, eps.real, eps.imaginary,
            slab.te_transmission.value, slab.tm_transmission.value, slab.te_reflection.value,
            slab.tm_reflection.value);
        return;
    }
    Table table;
    table.set("material", a.material);
    table.set("thickness_m", thickness.value);
    table.set("frequency_hz", frequency.value);
    table.set("angle_deg", a.angle);
    table.set("permittivity_real", eps.real);
    table.set("permittivity_imaginary", eps.imaginary);
    table.set("te_transmission_loss_db", slab.te_transmission.value);
    table.set("tm_transmission_loss_db", slab.tm_transmission.value);
    table.set("te_reflection_loss_db", slab.te_reflection.value);
    table.set("tm_reflection_loss_db", slab.tm_reflection.value);
    fmt::print("{}", to_json(table));
}

}  // namespace rovernet::cli
