#include "bie/pictures/labels.hpp"

#include <algorithm>
#include <array>

#include "bie/pictures/gnuplot.hpp"

namespace vehd {
namespace {

struct LabelRow {
  std::string_view name, label;
};

constexpr std::array key_rows = {LabelRow{"electric.conductivity_in", "conductivity inside σ_i"},
                                 LabelRow{"electric.conductivity_out", "conductivity outside σ_e"},
                                 LabelRow{"electric.permittivity", "permittivity ε"},
                                 LabelRow{"electric.waveform.frequency", "frequency"},
                                 LabelRow{"flow.rate", "shear rate"},
                                 LabelRow{"fluid.viscosity", "viscosity μ_e"},
                                 LabelRow{"fluid.viscosity_ratio", "viscosity ratio μ_i/μ_e"},
                                 LabelRow{"membrane.bending_modulus", "bending modulus κ_B"},
                                 LabelRow{"membrane.capacitance", "capacitance C_m"},
                                 LabelRow{"membrane.conductance", "conductance G_m"},
                                 LabelRow{"shape.reduced_volume", "reduced volume"},
                                 LabelRow{"suspension.volume_fraction", "volume fraction"}};

constexpr std::array column_rows = {LabelRow{"aspect_ratio_field", "aspect ratio along the field"},
                                    LabelRow{"bending_energy_scaled", "bending energy ∫H² dγ"},
                                    LabelRow{"effective_viscosity_intrinsic", "intrinsic viscosity [η]"},
                                    LabelRow{"inclination_deg", "inclination (degrees)"},
                                    LabelRow{"tension_integral", "tension ∫λ dγ"},
                                    LabelRow{"Vm_max", "largest |V_m|"},
                                    LabelRow{"Vm_north", "V_m at the north pole"},
                                    LabelRow{"q_north", "q at the north pole"}};

template <std::size_t kRows>
std::string_view label_among(const std::array<LabelRow, kRows>& rows, std::string_view name) {
  const auto* const row = std::ranges::find(rows, name, &LabelRow::name);
  return row == rows.end() ? std::string_view{} : row->label;
}

}  // namespace

std::string key_label(std::string_view key) {
  const std::string_view label = label_among(key_rows, key);
  return label.empty() ? gnuplot_literal(std::string(key)) : std::string(label);
}

std::string column_title(std::string_view column) {
  std::string title(label_among(column_rows, column));
  if (title.empty()) {
    title = column;
    std::ranges::replace(title, '_', ' ');
  }
  return title;
}

}  // namespace vehd
