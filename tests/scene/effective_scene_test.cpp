#include "bie/scene/effective_scene.hpp"

#include <boost/test/unit_test.hpp>
#include <regex>

#include "bie/scene/schema.hpp"
#include "bie/scene/units.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(effective_scene)

namespace {

const std::string every_table = with_appended(
    "[membrane]\nbending_modulus = 0.30000000000000004\nconductance = 5\n"
    "[flow]\nkind = 'gradient'\ngradient = [[0, 0, 1e-50], [0, 0, 0], [0, 0, 0]]\n"
    "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1e-8\nconductivity_out = 2\ninitial_Vm = 'steady'\n"
    "[output]\nevery = 0.1\n");

}  // namespace

BOOST_AUTO_TEST_CASE(reads_back_to_the_same_scene) {
  const std::string radial =
      "[shape]\nkind='radial'\nbase=1\namplitude=0.2\nexponent=-3\nmodes=[{n=3,m=2,a=1},{n=2,m=-1,a=0.1}]\n"
      "[flow]\nkind='planar_extension'\nrate=0.1\n[numerics]\nsymmetry='off'\ndt=0.1\nend_time=1\n";
  const std::string placed =
      "[shape]\nkind='biconcave'\nreduced_volume=0.6\narea=2\nrotation=[0,1,0.5,30]\ncentre=[0.1,0,-1]\n"
      "[numerics]\ndt=0.1\nend_time=1\n";
  const std::string wavy = "[shape]\nkind='radial'\nmodes=[{n=2,m=0,a=0.1}]\n[numerics]\ndt=0.1\nend_time=1\n";
  for (const std::string& text : {with_appended(""), every_table, radial, wavy, placed, si_scene()}) {
    const vehd::Scene scene = parsed(text);
    const std::string written = vehd::effective_scene(scene);
    BOOST_TEST((parsed(written) == scene), written);
    BOOST_TEST(vehd::effective_scene(parsed(written)) == written);
  }
}

BOOST_AUTO_TEST_CASE(spells_out_every_default) {
  const std::string text = vehd::effective_scene(parsed(with_appended("")));
  for (const char* line : {"inextensible = true\n", "viscosity = 1.0\n", "symmetry = \"auto\"\n", "degree = 8\n"}) {
    BOOST_TEST(text.find(line) != std::string::npos, line);
  }
  BOOST_TEST(text.find("[electric]") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(is_dimensionless_plus_the_units) {
  const std::string text = vehd::effective_scene(parsed(si_scene()));
  BOOST_TEST(text.find("length = \"1e-05 m\"\n") != std::string::npos, text);
  BOOST_TEST(text.find("time = \"0.5 s\"\n") != std::string::npos, text);
  const std::string values = text.substr(text.find("[shape]"));
  BOOST_TEST(!std::regex_search(values, std::regex("\"[0-9]")), values);
  BOOST_TEST(values.find("dt = 0.02\n") != std::string::npos, values);
}

BOOST_AUTO_TEST_CASE(differences_are_named) {
  const vehd::Scene a = parsed(every_table);
  vehd::Scene b = a;
  BOOST_TEST(vehd::differing_keys(a, b).empty());
  b.membrane.bending_modulus = 0.3;
  b.numerics.end_time = 2.0;
  b.electric.reset();
  const auto names = vehd::differing_keys(a, b);
  const auto has = [&](const char* name) { return std::find(names.begin(), names.end(), name) != names.end(); };
  BOOST_TEST(has("membrane.bending_modulus"));
  BOOST_TEST(has("numerics.end_time"));
  BOOST_TEST(has("electric.field"));
  BOOST_TEST(!has("numerics.dt"));
}

BOOST_AUTO_TEST_CASE(text_values_are_escaped) {
  vehd::Scene scene = parsed(with_appended(""));
  const std::string path = "/a \"quoted\" \\ path\n\twith \x01 control";
  BOOST_TEST(vehd::to_toml(vehd::Value(path)) == "\"/a \\\"quoted\\\" \\\\ path\\u000A\\u0009with \\u0001 control\"");
}

BOOST_AUTO_TEST_CASE(every_key_is_described) {
  for (const vehd::KeyDescription& key : vehd::scene_keys()) {
    BOOST_TEST(!key.description.empty(), key.name);
    BOOST_TEST((key.type != vehd::ValueType::word || !key.words.empty()), key.name);
    BOOST_TEST((key.type != vehd::ValueType::number || !key.unit.empty()), key.name);
    BOOST_TEST((key.unit.empty() || key.unit == "1" || vehd::find_dimension(key.unit) != nullptr), key.name);
    for (const std::string_view kind : key.kinds) {
      const auto& words = vehd::kind_key(key.table)->words;
      BOOST_TEST((std::find(words.begin(), words.end(), kind) != words.end()), key.name);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
