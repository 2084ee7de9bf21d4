#include "bie/scene/settings.hpp"

#include <boost/test/unit_test.hpp>
#include <filesystem>

#include "bie/scene/effective_scene.hpp"
#include "bie/scene/key_lookup.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/files.hpp"

namespace {

using Settings = std::vector<std::string>;

const std::string in_shear = with_appended("[flow]\nkind = \"shear\"\nrate = 1.0\n");

vehd::Scene with(const Settings& settings, const std::string& text = in_shear) {
  return vehd::parse_scene(text, "scene.toml", "/folder", settings);
}

std::string problem_of(const Settings& settings, const std::string& text = in_shear) {
  try {
    with(settings, text);
  } catch (const vehd::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

BOOST_AUTO_TEST_SUITE(settings)

BOOST_AUTO_TEST_CASE(replace_the_values_of_the_file) {
  const vehd::Scene scene =
      with({"flow.rate=2.5", "numerics.end_time = 4", "membrane.bending_modulus=1", "shape.axes=[1, 2, 3]"});
  BOOST_TEST(scene.flow->rate == 2.5);
  BOOST_TEST(scene.numerics.end_time == 4.0);
  BOOST_TEST(*scene.membrane.bending_modulus == 1.0);
  BOOST_TEST((scene.shape.axes == vehd::Triple{1.0, 2.0, 3.0}));
  BOOST_TEST(scene.numerics.order == 8);
  const std::string edited = with_appended("[flow]\nkind = \"shear\"\nrate = 2.5\n");
  BOOST_TEST((with({"flow.rate=2.5"}) == parsed(edited)));
  BOOST_TEST(vehd::effective_scene(with({"flow.rate=2.5"})).find("rate = 2.5\n") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(of_two_for_one_key_the_later_counts) {
  BOOST_TEST(with({"flow.rate=2", "flow.rate=3"}).flow->rate == 3.0);
}

BOOST_AUTO_TEST_CASE(a_value_that_is_no_toml_is_a_text) {
  BOOST_TEST((with({"flow.kind=planar_extension"}).flow->kind == vehd::FlowKind::planar_extension));
  BOOST_TEST((with({"flow.kind=\"planar_extension\""}).flow->kind == vehd::FlowKind::planar_extension));
  BOOST_TEST(with({"flow.rate=4 1/s"}, si_scene()).flow->rate == 2.0);
  BOOST_TEST(with({"electric.field=[0, 0, \"0.2 kV/cm\"]"}, si_scene()).electric->field[2] ==
             2.0 * parsed(si_scene()).electric->field[2]);
}

// The reference scales follow as if the file contained the settings.
BOOST_AUTO_TEST_CASE(give_whole_tables_and_units) {
  BOOST_TEST((with({"gravity.acceleration=[0, 0, -1]", "fluid.density_difference=1"}).gravity->acceleration ==
              vehd::Triple{0.0, 0.0, -1.0}));
  const vehd::Scene scene = with({"flow.waveform.kind=ac", "flow.waveform.frequency=0.5"});
  BOOST_TEST(scene.flow->waveform->frequency == 0.5);
  BOOST_TEST(*with({"units.length=20 um"}, si_scene()).units->length == 2e-5);
}

BOOST_AUTO_TEST_CASE(messages_name_the_option) {
  BOOST_TEST(problem_of({"flow.rate=x"}) ==
             "--set flow.rate=x: \"rate\" in [flow] is the text 'x'; accepted: any finite number");
  BOOST_TEST(problem_of({"flow.rtae=1"}) ==
             "--set flow.rtae=1: unknown key \"rtae\" in [flow]; did you mean \"rate\"?");
  BOOST_TEST(problem_of({"flwo.rate=1"}) == "--set flwo.rate=1: unknown table \"flwo\"; did you mean \"flow\"?");
  BOOST_TEST(problem_of({"fluid.viscosity=-1"}) ==
             "--set fluid.viscosity=-1: \"viscosity\" in [fluid] is -1; accepted: a number > 0");
  BOOST_TEST(problem_of({"shape.axes=[1, 1, x]"}) ==
             "--set shape.axes=[1, 1, x]: \"axes\" in [shape] is the text '[1, 1, x]'; accepted: 3 numbers [x, y, z], "
             "each 1e-30 ... 1e+30");
  BOOST_TEST(
      problem_of({"shape.axes=[1, 1, -1]"}).starts_with("--set shape.axes=[1, 1, -1]: \"axes\" in [shape] is -1"));
  BOOST_TEST(problem_of({"electric.conductivity_in=1"})
                 .starts_with("--set electric.conductivity_in=1: missing key \"field\" in [electric]"));
  BOOST_TEST(problem_of({"flow.rate=1", "flow.waveform.kind=ac", "flow.waveform.frequency=9"})
                 .starts_with("--set flow.waveform.frequency=9: "));
  BOOST_TEST(problem_of({"numerics.dt=1e-12", "numerics.end_time=1"}).starts_with("--set numerics.dt=1e-12: "));
  // Errors in the file are still reported with their place in it.
  BOOST_TEST(problem_of({"flow.rate=1"}, with_appended("[flow]\nkind = \"shear\"\nrtae = 1\n")) ==
             "scene.toml:10: unknown key \"rtae\" in [flow]; did you mean \"rate\"?");
}

BOOST_AUTO_TEST_CASE(have_one_form) {
  const std::string form = "accepted: table.key=value, as in flow.rate=2.5";
  BOOST_TEST(problem_of({"flow.rate"}) == "--set flow.rate: no value; " + form);
  BOOST_TEST(problem_of({""}) == "--set : no value; " + form);
  BOOST_TEST(problem_of({"=1"}) == "--set =1: \"\" is not a key; " + form);
  BOOST_TEST(problem_of({"flow..rate=1"}) == "--set flow..rate=1: \"flow..rate\" is not a key; " + form);
  BOOST_TEST(problem_of({"a.b.c.d=1"}) == "--set a.b.c.d=1: \"a.b.c.d\" is not a key; " + form);
  BOOST_TEST(problem_of({"rate=1"}) == "--set rate=1: \"rate\" has no table; accepted: flow.rate");
  BOOST_TEST(problem_of({"flow={}"}) == "--set flow={}: \"flow\" is a table; " + form);
  BOOST_TEST(problem_of({"rat=1"}) == "--set rat=1: \"rat\" has no table; " + form);
}

BOOST_AUTO_TEST_CASE(numbers_are_those_of_toml) {
  BOOST_TEST(problem_of({"flow.rate=.5"}) == "--set flow.rate=.5: .5 is not a TOML number; write 0.5");
  BOOST_TEST(problem_of({"flow.rate=-2."}) == "--set flow.rate=-2.: -2. is not a TOML number; write -2");
}

BOOST_AUTO_TEST_CASE(give_one_key_and_no_more) {
  BOOST_TEST(problem_of({"flow.rate=1\n[gravity]\nacceleration=[0, 0, 1]"}).find("\"rate\" in [flow] is the text") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_key_is_found_in_the_option_that_gives_it) {
  const TemporaryDirectory directory;
  const std::string file = directory / "scene.toml";
  write_text(file, in_shear);
  const vehd::SceneSource source{file, {"flow.rate=2"}};
  BOOST_TEST(vehd::key_place(source, "flow.rate") == "--set flow.rate=2");
  BOOST_TEST(vehd::key_place(source, "flow.kind") == file + ":9");
  BOOST_TEST(vehd::key_place(source, "numerics.degree") == file + ":7");
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(degree)

BOOST_AUTO_TEST_CASE(is_also_called_order) {
  const std::string start = "[shape]\nkind = 'ellipsoid'\naxes = [1, 1, 2]\n[numerics]\ndt = 0.1\nend_time = 1\n";
  BOOST_TEST((parsed(start + "degree = 12\n") == parsed(start + "order = 12\n")));
  BOOST_TEST(parsed(start + "degree = 12\n").numerics.order == 12);
  BOOST_TEST(parsed(start + "tolerance = 1e-3\ndegree = 12\n").numerics.order == 12);
  BOOST_TEST(parsed(start + "tolerance = 1e-3\norder = 12\n").numerics.order == 12);
  BOOST_TEST(vehd::effective_scene(parsed(start + "order = 12\n")).find("\ndegree = 12\n") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(is_given_once) {
  const std::string both = with_appended("degree = 8\n");
  BOOST_TEST(message_of(both) ==
             "scene.toml:7: \"order\" in [numerics] is another name of \"degree\", which is there as well; accepted: "
             "one of them");
  // A setting replaces the key under either of its names.
  for (const char* name : {"degree", "order"}) {
    BOOST_TEST(with({std::string("numerics.") + name + "=10"}).numerics.order == 10, name);
  }
}

BOOST_AUTO_TEST_CASE(has_in_messages_the_name_that_the_file_uses) {
  const std::string start = "[shape]\nkind = 'ellipsoid'\naxes = [1, 1, 2]\n[numerics]\ndt = 0.1\nend_time = 1\n";
  BOOST_TEST(message_of(start + "degree = 3\n") ==
             "scene.toml:7: \"degree\" in [numerics] is 3; accepted: an integer, 4 ... 64");
  BOOST_TEST(message_of(start + "order = 3\n") ==
             "scene.toml:7: \"order\" in [numerics] is 3; accepted: an integer, 4 ... 64");
  BOOST_TEST(message_of(start + "degre = 3\n") ==
             "scene.toml:7: unknown key \"degre\" in [numerics]; did you mean \"degree\"?");
}

// A setting selects one of several vesicles by the name of the file or by number.
BOOST_AUTO_TEST_CASE(are_for_one_of_several_vesicles) {
  const std::string two = with_appended(
      "[membrane]\nbending_modulus = 1\n[[vesicle]]\nname = \"a.b\"\n[[vesicle]]\nshape.centre = [5, 0, 0]\n");
  const vehd::Scene scene = with({"vesicle.a.b.membrane.bending_modulus=3", "vesicle.1.shape.centre=[6, 0, 0]"}, two);
  BOOST_TEST(*scene.vesicles[0].membrane.bending_modulus == 3.0);
  BOOST_TEST(*scene.vesicles[1].membrane.bending_modulus == 1.0);
  BOOST_TEST(scene.vesicles[1].shape.centre[0] == 6.0);
  BOOST_TEST(problem_of({"vesicle.c.fluid.viscosity_ratio=2"}, two) ==
             "--set vesicle.c.fluid.viscosity_ratio=2: \"vesicle.c.fluid.viscosity_ratio\" is not a key of a vesicle; "
             "accepted: vesicle.NAME.table.key, NAME of a.b, 1");
  BOOST_TEST(
      problem_of({"vesicle.1.fluid.viscosity=2"}, two)
          .starts_with("--set vesicle.1.fluid.viscosity=2: \"viscosity\" in [vesicle.fluid] is the same for all"));
  BOOST_TEST(problem_of({"vesicle.0.fluid.viscosity_ratio=2"}).ends_with("in a scene with tables [[vesicle]]"));
}

BOOST_AUTO_TEST_SUITE_END()
