// SPDX-License-Identifier: MIT
#include "cli/commands.hpp"
#include "experiment/loss_table.hpp"
#include "scenario/json.hpp"
#include "scenario/read_value.hpp"
#include "scene/p2040.hpp"

#include <fmt/format.h>

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

Radians incidence_of(double degrees) {
    constexpr double degree = 3.14159265358979323846 / 180;
    if (!(degrees >= 0 && degrees < 90)) {
        throw InputError(option("--angle", fmt::format("{}", degrees)),
                         "expected an angle to the normal from 0 to below 90 degrees");
    }
    return Radians{degrees * degree};
}

}  // namespace

void material(const MaterialArguments& a) {
    const ItuMaterial material = material_named(a.material);
    const Meters thickness = option_length("--thickness", a.thickness);
    const Hertz frequency = option_frequency("--frequency", a.frequency);
    const SlabLosses slab = slab_losses(material, thickness, frequency, incidence_of(a.angle));
    const Permittivity eps = permittivity(material, frequency);
    if (!a.json) {
        fmt::print(
            "{}, {:g} m thick, at {:g} GHz and {:g} degrees to the normal\n"
            "permittivity {:.4g} - {:.4g}j\n\n"
            "            TE [dB]     TM [dB]\n"
            "through  {:10.4f}  {:10.4f}\n"
            "back     {:10.4f}  {:10.4f}\n",
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
