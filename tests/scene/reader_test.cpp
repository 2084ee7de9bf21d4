#include <boost/test/unit_test.hpp>

#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(reader)

namespace {

/// Message of a scene whose last part is `more`, which starts at line 8.
std::string message_with(const std::string& more) { return message_of(with_appended(more)); }

std::string radial_scene(const std::string& modes, int order = 8) {
  return "[shape]\nkind = \"radial\"\nmodes = " + modes +
         "\n[numerics]\ndt = 0.1\nend_time = 1\norder = " + std::to_string(order) + "\n";
}

}  // namespace

BOOST_AUTO_TEST_CASE(accepts_a_minimal_scene_with_defaults) {
  const vehd::Scene scene = parsed("[shape]\nkind='ellipsoid'\naxes=[1,1,2]\n[numerics]\ndt=1\nend_time=0\n");
  BOOST_TEST(scene.numerics.order == 16);
  BOOST_TEST(scene.membrane.inextensible);
  BOOST_TEST(!scene.membrane.bending_modulus.has_value());
  BOOST_TEST(!scene.flow.has_value());
  BOOST_TEST(!scene.electric.has_value());
  BOOST_TEST(scene.shape.axes[2] == 2.0);
}

BOOST_AUTO_TEST_CASE(unknown_key_names_the_nearest) {
  BOOST_TEST(message_with("[fluid]\nviscocity = 1.0\n") ==
             "scene.toml:9: unknown key \"viscocity\" in [fluid]; did you mean \"viscosity\"?");
}

BOOST_AUTO_TEST_CASE(unknown_key_names_the_table_where_it_belongs) {
  BOOST_TEST(message_with("[fluid]\nconductance = 1.0\n") ==
             "scene.toml:9: unknown key \"conductance\" in [fluid]; it belongs to [membrane]");
}

BOOST_AUTO_TEST_CASE(unknown_table_names_the_nearest) {
  BOOST_TEST(message_with("[membran]\n") == "scene.toml:8: unknown table \"membran\"; did you mean \"membrane\"?");
}

BOOST_AUTO_TEST_CASE(unknown_table_in_a_table_names_the_nearest) {
  BOOST_TEST(message_with("[membrane.varing_bending]\n") ==
             "scene.toml:8: unknown key \"varing_bending\" in [membrane]; did you mean \"varying_bending\"?");
}

BOOST_AUTO_TEST_CASE(unknown_key_outside_of_tables) {
  BOOST_TEST(message_of("axis = 1\n") ==
             "scene.toml:1: unknown key \"axis\"; accepted: units, shape, membrane, fluid, gravity, contact, wall, "
             "flow, electric, poration, numerics, output, suspension, vesicle");
}

BOOST_AUTO_TEST_CASE(table_given_as_value) {
  BOOST_TEST(message_of("fluid = 3\n") == "scene.toml:1: \"fluid\" is 3; accepted: a table [fluid]");
}

BOOST_AUTO_TEST_CASE(wrong_types) {
  BOOST_TEST(message_with("[fluid]\nviscosity = \"high\"\n") ==
             "scene.toml:9: \"viscosity\" in [fluid] is the text 'high'; accepted: a number > 0");
  BOOST_TEST(message_with("[membrane]\ninextensible = 1\n") ==
             "scene.toml:9: \"inextensible\" in [membrane] is 1; accepted: true or false");
  BOOST_TEST(message_with("[fluid]\nviscosity = [1]\n").find("the array [ 1 ]") != std::string::npos);
  BOOST_TEST(message_with("[fluid]\nviscosity = true\n").find("is true; accepted: a number > 0") != std::string::npos);
  BOOST_TEST(message_of("[shape]\nkind='ellipsoid'\naxes=[1,2]\n") ==
             "scene.toml:3: \"axes\" in [shape] has 2 components; accepted: 3 numbers [x, y, z], each 1e-30 ... 1e+30");
  BOOST_TEST(message_of("[shape]\nkind=3\n") ==
             "scene.toml:2: \"kind\" in [shape] is 3; accepted: ellipsoid, prolate, oblate, biconcave, stomatocyte, "
             "radial, file");
}

BOOST_AUTO_TEST_CASE(non_physical_values) {
  BOOST_TEST(message_with("[fluid]\nviscosity = -1.0\n") ==
             "scene.toml:9: \"viscosity\" in [fluid] is -1.0; accepted: a number > 0");
  BOOST_TEST(message_with("[membrane]\nbending_modulus = -0.1\n") ==
             "scene.toml:9: \"bending_modulus\" in [membrane] is -0.1; accepted: a number >= 0");
  BOOST_TEST(message_with("[output]\nevery = 0\n") ==
             "scene.toml:9: \"every\" in [output] is 0; accepted: a number > 0");
  BOOST_TEST(message_of("[shape]\nkind='ellipsoid'\naxes=[1,1,-2]\n").find("is -2;") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(nan_and_infinity_are_named) {
  BOOST_TEST(message_with("[membrane]\nbending_modulus = nan\n") ==
             "scene.toml:9: \"bending_modulus\" in [membrane] is nan, not a finite number; accepted: a number >= 0");
  BOOST_TEST(message_with("[flow]\nkind = \"shear\"\nrate = -inf\n") ==
             "scene.toml:10: \"rate\" in [flow] is -inf, not a finite number; accepted: any finite number");
}

BOOST_AUTO_TEST_CASE(order_out_of_range) {
  const std::string start = "[shape]\nkind='ellipsoid'\naxes=[1,1,1]\n[numerics]\ndt=1\nend_time=1\norder = ";
  const std::string accepted = "; accepted: an integer, 4 ... 64";
  BOOST_TEST(message_of(start + "3\n") == "scene.toml:7: \"order\" in [numerics] is 3" + accepted);
  BOOST_TEST(message_of(start + "65\n") == "scene.toml:7: \"order\" in [numerics] is 65" + accepted);
  BOOST_TEST(message_of(start + "1000000000\n") == "scene.toml:7: \"order\" in [numerics] is 1000000000" + accepted);
  BOOST_TEST(message_of(start + "16.0\n") == "scene.toml:7: \"order\" in [numerics] is 16.0" + accepted);
  BOOST_TEST(message_of(start + "4\n") == "");
  BOOST_TEST(message_of(start + "64\n") == "");
}

BOOST_AUTO_TEST_CASE(time_step_and_counts) {
  const std::string start = "[shape]\nkind='ellipsoid'\naxes=[1,1,1]\n[numerics]\n";
  BOOST_TEST(message_of(start + "dt=0\nend_time=1\n") ==
             "scene.toml:5: \"dt\" in [numerics] is 0; accepted: a number > 0");
  BOOST_TEST(message_of(start + "dt=1\nend_time=1e12\n").find("scene.toml:5: \"dt\" in [numerics] makes 1e+12 steps") ==
             0);
  BOOST_TEST(message_of(start + "dt=1\nend_time=100\n[output]\nevery=1e-5\n").find("scene.toml:8: \"every\"") == 0);
}

BOOST_AUTO_TEST_CASE(missing_parts) {
  BOOST_TEST(message_of("[numerics]\ndt=1\nend_time=1\n") == "scene.toml:1: missing table [shape] (initial shape)");
  BOOST_TEST(message_of("[shape]\naxes=[1,1,1]\n") ==
             "scene.toml:1: missing key \"kind\" in [shape]; accepted: ellipsoid, prolate, oblate, biconcave, "
             "stomatocyte, radial, file");
  BOOST_TEST(message_with("[electric]\nfield=[0,0,1]\nconductivity_in=1\n")
                 .find("scene.toml:8: missing key \"conductivity_out\" in [electric]") == 0);
}

BOOST_AUTO_TEST_CASE(key_of_another_kind) {
  BOOST_TEST(message_with("[flow]\nkind='shear'\nrate=1\ngradient=[[0,0,1],[0,0,0],[0,0,0]]\n") ==
             "scene.toml:11: key \"gradient\" in [flow] belongs to kind \"gradient\", not to \"shear\"");
  BOOST_TEST(message_with("[flow]\nkind='gradient'\nrate=1\n") ==
             "scene.toml:10: key \"rate\" in [flow] belongs to kinds \"shear\", \"planar_extension\", "
             "\"axisymmetric_extension\", not to \"gradient\"");
}

BOOST_AUTO_TEST_CASE(excess_area_stands_for_a_reduced_volume) {
  const auto message = [](const std::string& shape) {
    return message_of("[shape]\n" + shape + "[numerics]\ndt=1\nend_time=1\n");
  };
  BOOST_TEST(message("kind='prolate'\nexcess_area=0.1\n") == "");
  BOOST_TEST(message("kind='prolate'\nexcess_area=0.1\nreduced_volume=0.9\n") ==
             "scene.toml:3: \"excess_area\" in [shape] together with \"reduced_volume\"; accepted: one of them");
  BOOST_TEST(
      message("kind='stomatocyte'\nexcess_area=0.1\n") ==
      "scene.toml:3: \"excess_area\" in [shape] is 0.1, a reduced volume of 0.988; accepted: a reduced volume of a "
      "number 0.1 ... 0.65");
  BOOST_TEST(
      message("kind='ellipsoid'\naxes=[1,1,1]\nexcess_area=0.1\n") ==
      "scene.toml:2: the shape in [shape] does not reach the reduced volume 0.9882, moved towards a sphere or away "
      "from it; accepted: another volume or shape");
}

BOOST_AUTO_TEST_CASE(unknown_key_names_all_tables_that_have_it) {
  BOOST_TEST(message_with("[membrane]\nviscosity = 1.0\n") ==
             "scene.toml:9: unknown key \"viscosity\" in [membrane]; it belongs to [units] or [fluid]");
}

BOOST_AUTO_TEST_CASE(reduced_volume_out_of_range) {
  const auto message = [](const std::string& kind, const std::string& value) {
    return message_of("[shape]\nkind='" + kind + "'\nreduced_volume=" + value + "\n[numerics]\ndt=1\nend_time=1\n");
  };
  const std::string start = "scene.toml:3: \"reduced_volume\" in [shape] is ";
  BOOST_TEST(message("prolate", "1.1") == start + "1.1; accepted: a number 0.2 ... 1");
  BOOST_TEST(message("prolate", "0") == start + "0; accepted: a number 0.2 ... 1");
  BOOST_TEST(message("oblate", "-0.5") == start + "-0.5; accepted: a number 0.1 ... 1");
  BOOST_TEST(message("biconcave", "0.8") == start + "0.8; accepted: a number 0.5 ... 0.75");
  BOOST_TEST(message("biconcave", "0.4") == start + "0.4; accepted: a number 0.5 ... 0.75");
  BOOST_TEST(message("prolate", "1.0") == "");
  BOOST_TEST(message_of("[shape]\nkind='prolate'\n[numerics]\ndt=1\nend_time=1\n")
                 .find("scene.toml:1: missing key \"reduced_volume\" in [shape]") == 0);
  BOOST_TEST(message_of("[shape]\nkind='biconcave'\n[numerics]\ndt=1\nend_time=1\n") == "");
}

BOOST_AUTO_TEST_CASE(placement_of_a_shape) {
  const auto message = [](const std::string& more) {
    return message_of("[shape]\nkind='biconcave'\n" + more + "\n[numerics]\ndt=1\nend_time=1\n");
  };
  BOOST_TEST(message("area=10\nscale=2") ==
             "scene.toml:4: \"scale\" in [shape] together with \"area\"; accepted: one of them");
  BOOST_TEST(message("area=0") == "scene.toml:3: \"area\" in [shape] is 0; accepted: a number > 0");
  BOOST_TEST(message("scale=-1") == "scene.toml:3: \"scale\" in [shape] is -1; accepted: a number 1e-30 ... 1e+30");
  BOOST_TEST(message("rotation=[0,0,0,90]") ==
             "scene.toml:3: \"rotation\" in [shape] has the axis 0, 0, 0; accepted: an axis that is not zero");
  BOOST_TEST(message("rotation=[0,0,1]") ==
             "scene.toml:3: \"rotation\" in [shape] has 3 components; accepted: 4 finite numbers "
             "[axis_x, axis_y, axis_z, degrees]");
  BOOST_TEST(message("centre=[0,nan,0]").find("scene.toml:3: \"centre\" in [shape] is nan, not a finite") == 0);
  BOOST_TEST(message("area=10\nrotation=[0,1,0,30]\ncentre=[1,2,3]") == "");
}

BOOST_AUTO_TEST_CASE(unknown_word_names_the_nearest) {
  BOOST_TEST(message_with("[flow]\nkind=\"sheer\"\n") ==
             "scene.toml:9: \"kind\" in [flow] is the text 'sheer'; did you mean \"shear\"?");
}

BOOST_AUTO_TEST_CASE(conductivities) {
  const std::string start = "[electric]\nfield=[0,0,1]\n";
  BOOST_TEST(message_with(start + "conductivity_in=-1\nconductivity_out=1\n") ==
             "scene.toml:10: \"conductivity_in\" in [electric] is -1; accepted: a number >= 0");
  BOOST_TEST(message_with(start + "conductivity_in=0\nconductivity_out=0\n").find("scene.toml:10:") == 0);
  BOOST_TEST(message_with(start + "conductivity_in=0\nconductivity_out=1\n") == "");
}

BOOST_AUTO_TEST_CASE(gradient_must_be_incompressible) {
  BOOST_TEST(message_with("[flow]\nkind='gradient'\ngradient=[[1,0,0],[0,0,0],[0,0,-0.5]]\n") ==
             "scene.toml:10: \"gradient\" in [flow] has the trace 0.5; accepted: 0 (incompressible flow)");
  BOOST_TEST(message_with("[flow]\nkind='gradient'\ngradient=[[0.1,0,0],[0,0.2,0],[0,0,-0.3]]\n") == "");
}

BOOST_AUTO_TEST_CASE(radial_modes) {
  BOOST_TEST(message_of(radial_scene("[{n=2, m=3, a=0.1}]")) ==
             "scene.toml:3: \"modes\" in [shape] has the mode n = 2, m = 3; accepted: entries "
             "{n = degree, m = -n ... n, a = finite number}");
  BOOST_TEST(message_of(radial_scene("[{n=9, m=0, a=0.1}]")) ==
             "scene.toml:3: \"modes\" in [shape] has the degree n = 9; accepted: at most the degree 8 of "
             "[numerics]");
  BOOST_TEST(message_of(radial_scene("[{n=-1, m=0, a=0.1}]")).find("degree n = -1") != std::string::npos);
  BOOST_TEST(message_of(radial_scene("[{n=2, m=0}]")).find("entry without \"a\"") != std::string::npos);
  BOOST_TEST(message_of(radial_scene("[{n=2, m=0, a=nan}]")).find("is nan, not a finite number") != std::string::npos);
  BOOST_TEST(message_of(radial_scene("[{n=2, m=0, b=1}]")).find("unknown key \"b\"") != std::string::npos);
  BOOST_TEST(message_of(radial_scene("[{n=2, m=0, a=9}]")).find("the radius in [shape] falls to -") !=
             std::string::npos);
  BOOST_TEST(message_of(radial_scene("[{n=2, m=-2, a=0.1}]")) == "");
}

BOOST_AUTO_TEST_CASE(overflowing_radius_is_refused) {
  BOOST_TEST(message_of("[shape]\nkind='radial'\namplitude=1\nexponent=1e30\nmodes=[{n=2,m=0,a=1}]\n"
                        "[numerics]\ndt=1\nend_time=1\n")
                 .find("the radius in [shape] falls to nan") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(exponent_needs_an_amplitude) {
  BOOST_TEST(
      message_of("[shape]\nkind='radial'\nexponent=2\nmodes=[{n=2,m=0,a=0.1}]\n[numerics]\ndt=1\nend_time=1\n") ==
      "scene.toml:3: \"exponent\" in [shape] has no effect without \"amplitude\"");
}

BOOST_AUTO_TEST_CASE(syntax_errors_name_the_line) {
  BOOST_TEST(message_of("[shape\nkind='ellipsoid'\n").find("scene.toml:1: ") == 0);
  BOOST_TEST(message_of("[shape]\nkind = \n").find("scene.toml:2: ") == 0);
  BOOST_TEST(message_of("[shape]\nkind='ellipsoid'\nkind='file'\n").find("scene.toml:3: ") == 0);
  BOOST_TEST(message_of("[shape]\naxes = [1, 2\n").find("scene.toml:") == 0);
  BOOST_TEST(message_of(std::string("[sha\0pe]\n", 9)).find("scene.toml:1: ") == 0);
  BOOST_TEST(message_of("\xff\xfe").find("scene.toml:1: ") == 0);
}

BOOST_AUTO_TEST_CASE(missing_shape_file) {
  BOOST_TEST(message_of("[shape]\nkind='file'\npath='absent.h5'\n[numerics]\ndt=1\nend_time=1\n") ==
             "scene.toml:3: \"path\" in [shape] is /folder/absent.h5: no such file");
}

BOOST_AUTO_TEST_CASE(missing_scene_file) {
  BOOST_CHECK_EXCEPTION(vehd::read_scene("/absent/scene.toml"), vehd::InputError, [](const vehd::InputError& error) {
    return std::string(error.what()) == "/absent/scene.toml: no such file";
  });
  BOOST_CHECK_EXCEPTION(vehd::read_scene("/tmp"), vehd::InputError, [](const vehd::InputError& error) {
    return std::string(error.what()).find("/tmp: not a file") == 0;
  });
}

BOOST_AUTO_TEST_SUITE_END()
