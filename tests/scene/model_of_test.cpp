#include "bie/scene/model_of.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/stepping/state/composition.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(model_of)

BOOST_AUTO_TEST_CASE(absent_tables_are_absent_effects) {
  const vehd::Model model = vehd::model_of(parsed(with_appended("")));
  BOOST_TEST(!model.vesicles[0].bending.has_value());
  BOOST_TEST(!model.flow.has_value());
  BOOST_TEST(!model.electric.has_value());
  BOOST_TEST(!vehd::needed_layers(model, model.vesicles[0], true).laplace_single);
  BOOST_TEST(model.vesicles[0].inextensible);
}

BOOST_AUTO_TEST_CASE(zero_bending_modulus_is_no_bending) {
  BOOST_TEST(
      !vehd::model_of(parsed(with_appended("[membrane]\nbending_modulus = 0\n"))).vesicles[0].bending.has_value());
}

BOOST_AUTO_TEST_CASE(values_arrive_where_they_belong) {
  const vehd::Model model = vehd::model_of(parsed(with_appended(
      "[membrane]\nbending_modulus=0.1\ninextensible=false\ncapacitance=2\nconductance=5\n[fluid]\nviscosity=3\n"
      "[flow]\nkind='shear'\nrate=0.5\n"
      "[electric]\nfield=[1,2,3]\nconductivity_in=4\nconductivity_out=6\npermittivity=7\n")));
  BOOST_TEST(model.vesicles[0].bending->modulus == 0.1);
  BOOST_TEST(!model.vesicles[0].inextensible);
  BOOST_TEST(model.viscosity == 3.0);
  BOOST_TEST(model.flow->gradient(0, 2) == 0.5);
  BOOST_TEST(model.electric->field(1) == 2.0);
  BOOST_TEST(model.vesicles[0].inside.conductivity == 4.0);
  BOOST_TEST(model.electric->conductivity == 6.0);
  BOOST_TEST(model.electric->permittivity == 7.0);
  BOOST_TEST(model.vesicles[0].charging.capacitance == 2.0);
  BOOST_TEST(model.vesicles[0].charging.conductance == 5.0);
}

BOOST_AUTO_TEST_CASE(gradient_rows_are_components_of_the_velocity) {
  const vehd::Model model =
      vehd::model_of(parsed(with_appended("[flow]\nkind='gradient'\ngradient=[[0,1,2],[3,0,4],[5,6,0]]\n")));
  BOOST_TEST(model.flow->gradient(0, 1) == 1.0);
  BOOST_TEST(model.flow->gradient(2, 0) == 5.0);
}

BOOST_AUTO_TEST_SUITE_END()
