#include "bie/support/instruments.hpp"

#include <boost/test/unit_test.hpp>
#include <thread>
#include <vector>

namespace {

void wait() { std::this_thread::sleep_for(std::chrono::milliseconds(20)); }

struct Listener : vehd::PartObserver {
  std::vector<std::string> heard;
  void begin(const std::string& part) override { heard.push_back("begin " + part); }
  void end() override { heard.emplace_back("end"); }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(instruments)

BOOST_AUTO_TEST_CASE(time_within_an_inner_part_is_not_counted_in_the_outer_one) {
  vehd::Instruments instruments;
  const auto start = std::chrono::steady_clock::now();
  {
    const auto outer = instruments.time("outer");
    wait();
    for (int i = 0; i < 3; ++i) {
      const auto inner = instruments.time("inner");
      wait();
    }
  }
  const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double inner = instruments.seconds().at("inner"), outer = instruments.seconds().at("outer");
  BOOST_TEST(inner >= 0.06);
  BOOST_TEST(outer >= 0.02);
  BOOST_TEST(inner + outer <= whole);
}

BOOST_AUTO_TEST_CASE(observer_hears_of_every_part) {
  Listener listener;
  vehd::Instruments instruments(&listener);
  {
    const auto outer = instruments.time("outer");
    const auto inner = instruments.time("inner");
  }
  const std::vector<std::string> expected{"begin outer", "begin inner", "end", "end"};
  BOOST_TEST(listener.heard == expected, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_SUITE_END()
