#include "bie/support/instruments.hpp"

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bie/support/parallel.hpp"

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

BOOST_AUTO_TEST_CASE(members_that_work_side_by_side_share_the_wall_time) {
  vehd::Instruments instruments;
  const auto start = std::chrono::steady_clock::now();
  {
    const auto outer = instruments.time("outer");
    vehd::for_each_member(20, instruments, [](vehd::Index i, vehd::Instruments& of_one) {
      const auto inner = of_one.time("inner");
      of_one.count_kernel("kernel", static_cast<std::uint64_t>(i));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
  }
  const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  BOOST_TEST(instruments.kernel_evaluations().at("kernel") == 190u);
  BOOST_TEST(instruments.seconds().at("inner") > 0.0);
  BOOST_TEST(instruments.seconds().at("outer") >= 0.0);
  BOOST_TEST(instruments.seconds().at("inner") + instruments.seconds().at("outer") <= whole);
}

BOOST_AUTO_TEST_CASE(chosen_members_are_called_by_their_own_numbers) {
  for (const std::size_t count : {3, 30}) {
    std::vector<std::size_t> members;
    for (std::size_t k = 0; k < count; ++k) members.push_back(2 * k + 1);
    std::vector<char> calls(2 * count);
    vehd::Instruments instruments;
    vehd::for_each_member(members, [&](std::size_t member) { ++calls[member]; });
    vehd::for_each_member(members, instruments, [&](std::size_t member, vehd::Instruments& of_one) {
      ++calls[member];
      of_one.count_kernel("kernel", member);
    });
    for (std::size_t i = 0; i < calls.size(); ++i) BOOST_TEST(calls[i] == (i % 2 == 1 ? 2 : 0));
    BOOST_TEST(instruments.kernel_evaluations().at("kernel") == count * count);
  }
}

BOOST_AUTO_TEST_CASE(the_first_member_that_throws_is_heard_when_all_have_ended) {
  for (const vehd::Index count : {5, 50}) {
    std::vector<char> done(static_cast<std::size_t>(count));
    const auto body = [&](vehd::Index i) {
      done[static_cast<std::size_t>(i)] = 1;
      if (i > 2) throw std::runtime_error(std::to_string(i));
    };
    BOOST_CHECK_EXCEPTION(vehd::for_each_member(count, body), std::runtime_error,
                          [](const std::runtime_error& error) { return error.what() == std::string("3"); });
    if (vehd::are_many(count)) BOOST_TEST(std::count(done.begin(), done.end(), 1) == count);
  }
}

BOOST_AUTO_TEST_SUITE_END()
