#pragma once

#include <algorithm>
#include <type_traits>

#include "bie/scene/schema.hpp"

/// Builds the rows of the key table: a row names the key and the member of scene.hpp that holds its value; type, getter
/// and setter follow from the member.
namespace vehd {

/// How a member is stored in a Value, and of which type its key is.
template <typename Member>
struct MemberTraits;

/// A member that is stored as it is.
template <typename Stored_, ValueType type_>
struct PlainMember {
  using Stored = Stored_;
  static constexpr ValueType type = type_;
};

template <>
struct MemberTraits<bool> : PlainMember<bool, ValueType::boolean> {};
template <>
struct MemberTraits<int> : PlainMember<std::int64_t, ValueType::integer> {};
template <>
struct MemberTraits<std::int64_t> : PlainMember<std::int64_t, ValueType::integer> {};
template <>
struct MemberTraits<double> : PlainMember<double, ValueType::number> {};
template <>
struct MemberTraits<std::string> : PlainMember<std::string, ValueType::text> {};
template <>
struct MemberTraits<Triple> : PlainMember<Triple, ValueType::triple> {};
template <>
struct MemberTraits<TripleOfTriples> : PlainMember<TripleOfTriples, ValueType::matrix> {};
template <>
struct MemberTraits<AxisAngle> : PlainMember<AxisAngle, ValueType::axis_angle> {};
template <>
struct MemberTraits<std::vector<double>> : PlainMember<std::vector<double>, ValueType::numbers> {};
template <>
struct MemberTraits<std::vector<HarmonicMode>> : PlainMember<std::vector<HarmonicMode>, ValueType::modes> {};
template <>
struct MemberTraits<std::vector<OutputWindow>> : PlainMember<std::vector<OutputWindow>, ValueType::windows> {};
template <typename Contained>
struct MemberTraits<std::optional<Contained>> : MemberTraits<Contained> {};

/// Rows of the key table in the making: begin() opens a table, add() a key of it.
class KeyTable {
 public:
  /// Words of a row.
  struct Text {
    std::string_view symbol, unit, description;
  };

  /// The table and the kinds to which the following keys belong.
  void begin(std::string_view table, std::vector<std::string_view> kinds = {}) {
    table_ = table;
    kinds_ = std::move(kinds);
  }

  /// @param part  maps a scene (const or not) to the struct that holds the member
  template <typename Part, typename Owner, typename Member>
  KeyDescription& add(std::string_view name, Range range, Text text, Part part, Member Owner::*member) {
    using Stored = typename MemberTraits<Member>::Stored;
    KeyDescription& key = add_row(name, MemberTraits<Member>::type, range, text);
    key.get = [=](const Scene& scene) -> std::optional<Value> {
      const Member& value = part(scene).*member;
      if constexpr (std::is_same_v<Member, std::optional<Stored>>) {
        return value ? std::optional<Value>(*value) : std::nullopt;
      } else {
        return Value(static_cast<Stored>(value));
      }
    };
    key.set = [=](Scene& scene, const Value& value) {
      part(scene).*member = static_cast<Member>(std::get<Stored>(value));
    };
    return key;
  }

  /// @param words  one for each enumerator of the member, in their order
  template <typename Part, typename Owner, typename Enumeration>
  KeyDescription& add_word(std::string_view name, std::vector<std::string_view> words, std::string_view description,
                           Part part, Enumeration Owner::*member) {
    KeyDescription& key = add_row(name, ValueType::word, {}, {"", "", description});
    key.words = words;
    key.get = [=](const Scene& scene) -> std::optional<Value> {
      return Value(std::string(words.at(static_cast<std::size_t>(part(scene).*member))));
    };
    key.set = [=](Scene& scene, const Value& value) {
      const auto found = std::find(words.begin(), words.end(), std::get<std::string>(value));
      part(scene).*member = static_cast<Enumeration>(found - words.begin());
    };
    return key;
  }

  /// The rows, in the order in which they were added.
  std::vector<KeyDescription> take() { return std::move(keys_); }

 private:
  KeyDescription& add_row(std::string_view name, ValueType type, Range range, Text text) {
    KeyDescription key;
    key.table = table_;
    key.name = name;
    key.type = type;
    key.symbol = text.symbol;
    key.unit = text.unit;
    key.range = range;
    key.kinds = kinds_;
    key.description = text.description;
    keys_.push_back(std::move(key));
    return keys_.back();
  }

  std::string_view table_;
  std::vector<std::string_view> kinds_;
  std::vector<KeyDescription> keys_;
};

/// Of [poration].
void add_poration_keys(KeyTable& table);
/// Of properties by place and of the pump, but for its waveform.
void add_place_keys(KeyTable& table);
/// Their tables.
std::vector<TableDescription> place_tables();

}  // namespace vehd
