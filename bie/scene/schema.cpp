#include "bie/scene/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vehd {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr Range any_number{};
constexpr Range positive{0.0, infinity, true};
constexpr Range not_negative{0.0, infinity, false};
constexpr Range semi_axis{1e-6, 1e6, false};

using Get = std::function<std::optional<Value>(const Scene&)>;
using Set = std::function<void(Scene&, const Value&)>;

/// Accessors of one member; `part` maps a scene (const or not) to the struct that holds it.
struct Access {
  Get get;
  Set set;
};

template <typename Stored, typename Part, typename Owner, typename Member>
Access access(Part part, Member Owner::*member) {
  return {
      [=](const Scene& scene) -> std::optional<Value> { return Value(static_cast<Stored>(part(scene).*member)); },
      [=](Scene& scene, const Value& value) { part(scene).*member = static_cast<Member>(std::get<Stored>(value)); }};
}

template <typename Part, typename Owner>
Access optional_access(Part part, std::optional<double> Owner::*member) {
  return {[=](const Scene& scene) -> std::optional<Value> {
            const auto& stored = part(scene).*member;
            return stored ? std::optional<Value>(*stored) : std::nullopt;
          },
          [=](Scene& scene, const Value& value) { part(scene).*member = std::get<double>(value); }};
}

/// The words stand in the order of the enumerators.
template <typename Part, typename Owner, typename Enumeration>
Access word_access(Part part, Enumeration Owner::*member, std::vector<std::string_view> words) {
  return {[=](const Scene& scene) -> std::optional<Value> {
            return Value(std::string(words.at(static_cast<std::size_t>(part(scene).*member))));
          },
          [=](Scene& scene, const Value& value) {
            const auto found = std::find(words.begin(), words.end(), std::get<std::string>(value));
            part(scene).*member = static_cast<Enumeration>(found - words.begin());
          }};
}

const auto shape = [](auto& scene) -> auto& { return scene.shape; };
const auto membrane = [](auto& scene) -> auto& { return scene.membrane; };
const auto fluid = [](auto& scene) -> auto& { return scene.fluid; };
const auto flow = [](auto& scene) -> auto& { return *scene.flow; };
const auto electric = [](auto& scene) -> auto& { return *scene.electric; };
const auto numerics = [](auto& scene) -> auto& { return scene.numerics; };
const auto output = [](auto& scene) -> auto& { return scene.output; };

class KeyTable {
 public:
  struct Text {
    std::string_view symbol, unit, description;
  };

  /// The table and kind to which the following keys belong.
  void begin(std::string_view table, std::string_view kind = {}) {
    table_ = table;
    kind_ = kind;
  }

  KeyDescription& add(std::string_view name, ValueType type, Range range, Text text, Access accessors) {
    KeyDescription key;
    key.table = table_;
    key.name = name;
    key.type = type;
    key.symbol = text.symbol;
    key.unit = text.unit;
    key.range = range;
    key.kind = kind_;
    key.description = text.description;
    key.get = std::move(accessors.get);
    key.set = std::move(accessors.set);
    keys_.push_back(std::move(key));
    return keys_.back();
  }

  template <typename Part, typename Member>
  KeyDescription& add_word(std::string_view name, std::vector<std::string_view> words, std::string_view description,
                           Part part, Member member) {
    KeyDescription& key =
        add(name, ValueType::word, any_number, {"", "", description}, word_access(part, member, words));
    key.words = std::move(words);
    return key;
  }

  std::vector<KeyDescription> take() { return std::move(keys_); }

 private:
  std::string_view table_, kind_;
  std::vector<KeyDescription> keys_;
};

void add_shape_keys(KeyTable& table) {
  table.begin("shape");
  table.add_word("kind", {"ellipsoid", "radial", "file"}, "how the initial shape is given", shape, &ShapeScene::kind)
      .required = true;
  table.begin("shape", "ellipsoid");
  table
      .add("axes", ValueType::triple, semi_axis, {"", "length", "semi-axes along x, y, z"},
           access<Triple>(shape, &ShapeScene::axes))
      .required = true;
  table.begin("shape", "radial");
  table.add("base", ValueType::number, any_number, {"", "length", "constant part of the radius"},
            access<double>(shape, &ShapeScene::base));
  table.add("amplitude", ValueType::number, any_number,
            {"", "length", "radius = base + amplitude exp(exponent s); absent: base + s"},
            optional_access(shape, &ShapeScene::amplitude));
  table.add("exponent", ValueType::number, any_number, {"", "1", "factor of s in the exponential"},
            access<double>(shape, &ShapeScene::exponent));
  table
      .add("modes", ValueType::modes, any_number,
           {"", "1", "s = sum of a Re Y_n^m of Eq. (17), entries {n, m, a}; m < 0 takes Im Y_n^|m|"},
           access<std::vector<HarmonicMode>>(shape, &ShapeScene::modes))
      .required = true;
  table.begin("shape", "file");
  table
      .add("path", ValueType::text, any_number, {"", "", "run.h5 that holds the shape, relative to the scene file"},
           access<std::string>(shape, &ShapeScene::path))
      .required = true;
  table.add("time", ValueType::number, not_negative, {"t", "time", "time of the snapshot; absent: the last one"},
            optional_access(shape, &ShapeScene::time));
}

void add_membrane_keys(KeyTable& table) {
  table.begin("membrane");
  table.add("bending_modulus", ValueType::number, not_negative,
            {"κ_B", "energy", "E = κ_B ∫H² dA, twice the Helfrich modulus; absent or 0: no bending"},
            optional_access(membrane, &MembraneScene::bending_modulus));
  table.add("inextensible", ValueType::boolean, any_number, {"", "", "local area is conserved by a tension, Eq. (1c)"},
            access<bool>(membrane, &MembraneScene::inextensible));
  table.add("capacitance", ValueType::number, positive, {"C_m", "capacitance/area", "used with [electric] only"},
            access<double>(membrane, &MembraneScene::capacitance));
  table.add("conductance", ValueType::number, not_negative, {"G_m", "conductance/area", "used with [electric] only"},
            access<double>(membrane, &MembraneScene::conductance));
}

void add_fluid_keys(KeyTable& table) {
  table.begin("fluid");
  table.add("viscosity", ValueType::number, positive, {"μ", "viscosity", "inside and outside"},
            access<double>(fluid, &FluidScene::viscosity));
}

void add_flow_keys(KeyTable& table) {
  table.begin("flow");
  table
      .add_word("kind", {"shear", "planar_extension", "axisymmetric_extension", "gradient"},
                "rate (z, 0, 0), rate (x, 0, -z), rate (-x/2, -y/2, z), or any gradient", flow, &FlowScene::kind)
      .required = true;
  for (const std::string_view kind : {"shear", "planar_extension", "axisymmetric_extension"}) {
    table.begin("flow", kind);
    table
        .add("rate", ValueType::number, any_number, {"γ̇", "1/time", "velocity gradient"},
             access<double>(flow, &FlowScene::rate))
        .required = true;
  }
  table.begin("flow", "gradient");
  table
      .add("gradient", ValueType::matrix, any_number, {"∇v", "1/time", "rows dv_i/dx_j of trace zero"},
           access<TripleOfTriples>(flow, &FlowScene::gradient))
      .required = true;
}

void add_electric_keys(KeyTable& table) {
  table.begin("electric");
  table
      .add("field", ValueType::triple, any_number, {"E_∞", "field", "applied uniform field"},
           access<Triple>(electric, &ElectricScene::field))
      .required = true;
  table
      .add("conductivity_in", ValueType::number, not_negative, {"σ_i", "conductivity", "of the fluid inside"},
           access<double>(electric, &ElectricScene::conductivity_in))
      .required = true;
  table
      .add("conductivity_out", ValueType::number, not_negative, {"σ_e", "conductivity", "of the fluid outside"},
           access<double>(electric, &ElectricScene::conductivity_out))
      .required = true;
  table.add("permittivity", ValueType::number, positive, {"ε", "permittivity", "inside and outside"},
            access<double>(electric, &ElectricScene::permittivity));
  table.add_word("initial_Vm", {"zero", "steady"}, "transmembrane potential at time 0", electric,
                 &ElectricScene::initial_potential);
}

void add_numerics_keys(KeyTable& table) {
  table.begin("numerics");
  table.add("order", ValueType::integer, {4, 64, false}, {"p", "1", "degree of the spherical harmonics"},
            access<std::int64_t>(numerics, &NumericsScene::order));
  table
      .add("dt", ValueType::number, positive, {"Δt", "time", "largest time step"},
           access<double>(numerics, &NumericsScene::dt))
      .required = true;
  table
      .add("end_time", ValueType::number, not_negative, {"", "time", "0 solves and writes the initial state alone"},
           access<double>(numerics, &NumericsScene::end_time))
      .required = true;
  table.add_word("symmetry", {"auto", "off"}, "whether symmetries of the scene may be used", numerics,
                 &NumericsScene::symmetry);
}

void add_output_keys(KeyTable& table) {
  table.begin("output");
  table.add("every", ValueType::number, positive,
            {"", "time", "time between snapshots; absent: the start and the end only"},
            optional_access(output, &OutputScene::every));
}

std::vector<KeyDescription> make_keys() {
  KeyTable table;
  add_shape_keys(table);
  add_membrane_keys(table);
  add_fluid_keys(table);
  add_flow_keys(table);
  add_electric_keys(table);
  add_numerics_keys(table);
  add_output_keys(table);
  return table.take();
}

std::vector<TableDescription> make_tables() {
  const auto always = [](const Scene&) { return true; };
  const auto nothing = [](Scene&) {};
  return {
      {"shape", "initial shape", true, always, nothing},
      {"membrane", "mechanical and electric properties of the membrane", false, always, nothing},
      {"fluid", "the fluids inside and outside", false, always, nothing},
      {"flow", "background flow; absent: quiescent", false, [](const Scene& scene) { return scene.flow.has_value(); },
       [](Scene& scene) { scene.flow.emplace(); }},
      {"electric", "applied field; absent: nothing electric is assembled", false,
       [](const Scene& scene) { return scene.electric.has_value(); }, [](Scene& scene) { scene.electric.emplace(); }},
      {"numerics", "resolution in space and time", true, always, nothing},
      {"output", "what is written", false, always, nothing},
  };
}

std::string number_to_toml(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".einf") == std::string::npos) text += ".0";
  return text;
}

std::string text_to_toml(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') {
      quoted += '\\';
      quoted += letter;
    } else if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f) {
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned char>(letter));
    } else {
      quoted += letter;
    }
  }
  return quoted + '"';
}

std::string triple_to_toml(const Triple& triple) {
  return fmt::format("[{}, {}, {}]", number_to_toml(triple[0]), number_to_toml(triple[1]), number_to_toml(triple[2]));
}

struct TomlText {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return number_to_toml(value); }
  std::string operator()(const std::string& value) const { return text_to_toml(value); }
  std::string operator()(const Triple& value) const { return triple_to_toml(value); }
  std::string operator()(const TripleOfTriples& rows) const {
    return fmt::format("[{}, {}, {}]", triple_to_toml(rows[0]), triple_to_toml(rows[1]), triple_to_toml(rows[2]));
  }
  std::string operator()(const std::vector<HarmonicMode>& modes) const {
    std::string text;
    for (const HarmonicMode& mode : modes) {
      text +=
          fmt::format("{}{{n = {}, m = {}, a = {}}}", text.empty() ? "" : ", ", mode.n, mode.m, number_to_toml(mode.a));
    }
    return "[" + text + "]";
  }
};

}  // namespace

bool Range::contains(double value) const {
  return std::isfinite(value) && value <= upper && (lower_excluded ? value > lower : value >= lower);
}

std::string Range::text() const {
  if (std::isinf(lower) && std::isinf(upper)) return "any finite number";
  if (std::isinf(upper)) return fmt::format("{} {}", lower_excluded ? ">" : ">=", lower);
  return fmt::format("{} ... {}", lower, upper);
}

const std::vector<TableDescription>& scene_tables() {
  static const std::vector<TableDescription> tables = make_tables();
  return tables;
}

const std::vector<KeyDescription>& scene_keys() {
  static const std::vector<KeyDescription> keys = make_keys();
  return keys;
}

const KeyDescription* find_key(std::string_view table, std::string_view name) {
  for (const KeyDescription& key : scene_keys()) {
    if (key.table == table && key.name == name) return &key;
  }
  return nullptr;
}

std::string kind_of(const Scene& scene, std::string_view table) {
  const KeyDescription* kind = find_key(table, "kind");
  return kind == nullptr ? std::string() : std::get<std::string>(*kind->get(scene));
}

bool applies(const KeyDescription& key, const Scene& scene) {
  const auto table = std::find_if(scene_tables().begin(), scene_tables().end(),
                                  [&](const TableDescription& candidate) { return candidate.name == key.table; });
  return table->present(scene) && (key.kind.empty() || key.kind == kind_of(scene, key.table));
}

std::string to_toml(const Value& value) { return std::visit(TomlText{}, value); }

std::vector<std::string> differing_keys(const Scene& a, const Scene& b) {
  std::vector<std::string> names;
  for (const KeyDescription& key : scene_keys()) {
    const auto value_a = applies(key, a) ? key.get(a) : std::nullopt;
    const auto value_b = applies(key, b) ? key.get(b) : std::nullopt;
    const std::string name = fmt::format("{}.{}", key.table, key.name);
    if (value_a != value_b && (names.empty() || names.back() != name)) names.push_back(name);
  }
  return names;
}

}  // namespace vehd
