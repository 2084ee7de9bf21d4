#include <boost/test/unit_test.hpp>

#include "bie/scene/dimensionless_groups.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/stepping/state/composition.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(averaged_field_scene)

namespace {

std::string scene_with(const std::string& electric, const std::string& waveform) {
  return with_appended("[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\n" + electric +
                       "[electric.waveform]\nkind = \"ac\"\nfrequency = 50\n" + waveform);
}

bool is_refused_for(const std::string& text, const std::string& what) {
  const std::string message = message_of(text);
  BOOST_TEST_MESSAGE(message);
  return message.find(what) != std::string::npos && message.find('\n') == std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_model_has_the_frequency_and_no_waveform) {
  const vehd::Scene scene = parsed(scene_with("permittivity = 2\ndisplacement_current = true\n", "average = true\n"));
  const vehd::Model model = vehd::model_of(scene);
  BOOST_TEST(vehd::is_averaged(model));
  BOOST_TEST(*model.electric->averaged_frequency == 50.0);
  BOOST_TEST(model.electric->displacement_current);
  for (const double time : {0.0, 0.3, 1.7}) BOOST_TEST(model.electric->waveform.at(time) == 1.0);
  // The steps resolve the shape, not the period.
  BOOST_TEST(vehd::step_control_of(scene).largest == 0.1);
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
}

BOOST_AUTO_TEST_CASE(a_burst_is_averaged_while_it_lasts) {
  std::string text = scene_with("", "average = true\nstart = 0.25\nduration = 0.5\n");
  text.replace(text.find("\"ac\""), 4, "\"burst\"");
  const vehd::Scene scene = parsed(text);
  const vehd::Model model = vehd::model_of(scene);
  BOOST_TEST(*model.electric->averaged_frequency == 50.0);
  BOOST_TEST((model.electric->waveform == vehd::Waveform::pulse(1.0, 0.25, 0.5)));
  BOOST_TEST(vehd::step_control_of(scene).largest == 0.1);
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
}

BOOST_AUTO_TEST_CASE(a_field_that_is_followed_in_time_is_none) {
  const vehd::Model model = vehd::model_of(parsed(with_appended(
      "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\n[electric.waveform]\nkind = \"ac\"\n"
      "frequency = 0.5\n")));
  BOOST_TEST(!vehd::is_averaged(model));
}

BOOST_AUTO_TEST_CASE(keys_without_effect_are_refused) {
  BOOST_TEST(is_refused_for(scene_with("initial_Vm = \"steady\"\n", "average = true\n"), "\"initial_Vm\""));
  BOOST_TEST(is_refused_for(scene_with("", "average = true\nphase = 1\n"), "\"phase\""));
  BOOST_TEST(is_refused_for(scene_with("displacement_current = true\n", "average = true\n"), "\"permittivity\""));
  BOOST_TEST(is_refused_for(scene_with("displacement_current = true\npermittivity = 1\ninitial_Vm = \"file\"\n", ""),
                            "\"displacement_current\""));
  BOOST_TEST(is_refused_for(with_appended("[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\n"
                                          "[electric.waveform]\nkind = \"pulse\"\nduration = 1\naverage = true\n"),
                            "belongs to kinds \"ac\", \"burst\""));
}

BOOST_AUTO_TEST_CASE(several_vesicles_have_displacement_currents_of_all_or_of_none) {
  const std::string field =
      "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\npermittivity = 1\n"
      "displacement_current = true\n";
  const std::string vesicles = "[[vesicle]]\n[[vesicle]]\nshape.centre = [9, 0, 0]\n";
  const vehd::Model model = vehd::model_of(parsed(with_appended(field + vesicles)));
  BOOST_TEST(model.vesicles.size() == 2U);
  BOOST_TEST(vehd::relaxes_charge(model));
  BOOST_TEST(is_refused_for(with_appended(field + vesicles + "electric.displacement_current = false\n"),
                            "is the same for all vesicles"));
  BOOST_TEST(is_refused_for(with_appended(field + vesicles + "electric.initial_Vm = \"file\"\n"), "\"initial_Vm\""));
}

BOOST_AUTO_TEST_CASE(different_permittivities_need_the_charge_where_they_count) {
  const auto needs = [](const std::string& electric) {
    const vehd::Model model = vehd::model_of(parsed(with_appended(
        "[electric]\nfield = [0, 0, 1]\nconductivity_in = 2\nconductivity_out = 2\npermittivity_ratio = 0.5\n" +
        electric + "[electric.waveform]\nkind = \"ac\"\nfrequency = 50\naverage = true\n")));
    return vehd::needed_layers(model, model.vesicles[0], true).laplace_adjoint;
  };
  BOOST_TEST(!needs(""));
  BOOST_TEST(needs("permittivity = 1\ndisplacement_current = true\n"));
}

BOOST_AUTO_TEST_CASE(plan_names_the_effects_that_the_average_leaves_out) {
  const auto ripple = [](const std::string& frequency) {
    const vehd::Scene scene = parsed(with_appended(
        "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\n[electric.waveform]\nkind = "
        "\"ac\"\naverage = true\nfrequency = " +
        frequency + "\n"));
    for (const auto& group : vehd::dimensionless_groups(scene)) {
      if (group.name == "ripple") return group.value;
    }
    return 0.0;
  };
  BOOST_TEST(ripple("1e3") > 0.0);
  // Far above the charging frequency Q₂ is determined by the fluids alone, and the ripple decreases like 1/f.
  BOOST_TEST(ripple("1e4") / ripple("1e5") == 10.0, boost::test_tools::tolerance(1e-3));
}

BOOST_AUTO_TEST_SUITE_END()
