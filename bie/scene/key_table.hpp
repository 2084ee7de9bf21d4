#pragma once

#include <algorithm>
#include <type_traits>

#include "bie/scene/schema.hpp"

/// Builds the rows of the key table: a row names the key and the member of scene.hpp that holds its value; type, getter
/// and setter follow from the member.
namespace vehd {

/// Type in which a member is stored in a Value.
template <typename Member>
struct StoredAs {
  using Type = Member;
};
template <>
struct StoredAs<int> {
  using Type = std::int64_t;
};
template <typename Contained>
struct StoredAs<std::optional<Contained>> : StoredAs<Contained> {};

/// Rows in the order in which tables and keys are read and written.
struct SchemaRows {
  std::vector<TableDescription> tables;
  std::vector<KeyDescription> keys;
};

/// Texts of a row.
struct RowText {
  std::string_view symbol, unit, description;
  bool is_required = false;
};

/// One table, to which keys and tables within it are added.
template <typename Part>
class KeyTable {
 public:
  /// @param part  maps a scene, const or not, to the struct of the table
  KeyTable(SchemaRows& rows, TableDescription table, Part part) : rows_(&rows), table_(std::move(table)), part_(part) {}

  /// A table that every scene has.
  template <typename Owner, typename Member>
  auto always(std::string_view name, Member Owner::*member, std::string_view description, bool is_required = false) {
    const auto part = [ owner = part_, member ](auto& scene) -> auto& { return owner(scene).*member; };
    rows_->tables.push_back({name, description, is_required, table_.present, table_.create});
    return KeyTable<decltype(part)>(*rows_, rows_->tables.back(), part);
  }

  /// A table whose presence switches an effect on; creating it creates its owner as well.
  template <typename Owner, typename Member>
  auto optional(std::string_view name, std::optional<Member> Owner::*member, std::string_view description) {
    const auto holder = [ owner = part_, member ](auto& scene) -> auto& { return owner(scene).*member; };
    const auto part = [holder](auto& scene) -> auto& { return *holder(scene); };
    const auto present = [owner = table_, holder](const Scene& scene) {
      return owner.present(scene) && holder(scene).has_value();
    };
    const auto create = [owner = table_, holder](Scene& scene) {
      if (!owner.present(scene)) owner.create(scene);
      holder(scene).emplace();
    };
    rows_->tables.push_back({name, description, false, present, create});
    return KeyTable<decltype(part)>(*rows_, rows_->tables.back(), part);
  }

  /// The table restricted to some of its kinds: keys added to it belong to these kinds only.
  template <typename... Kinds>
  [[nodiscard]] KeyTable of(Kinds... kinds) const {
    KeyTable result = *this;
    result.kinds_ = {kinds...};
    return result;
  }

  /// Adds a key that accepts any value.
  template <typename Owner, typename Member>
  KeyDescription& key(std::string_view name, Member Owner::*member, const RowText& text) {
    return key(name, member, Range{}, text);
  }
  template <typename Owner, typename Member>
  KeyDescription& key(std::string_view name, Member Owner::*member, Range range, const RowText& text) {
    using Stored = typename StoredAs<Member>::Type;
    KeyDescription& key = add_row(name, Stored{}, range, text);
    key.get = [part = part_, member](const Scene& scene) -> std::optional<Value> {
      const Member& value = part(scene).*member;
      if constexpr (std::is_same_v<Member, std::optional<Stored>>) {
        return value ? std::optional<Value>(*value) : std::nullopt;
      } else {
        return Value(static_cast<Stored>(value));
      }
    };
    key.set = [part = part_, member](Scene& scene, const Value& value) {
      part(scene).*member = static_cast<Member>(std::get<Stored>(value));
    };
    return key;
  }

  /// @param words  one for each enumerator of the member, in their order
  template <typename Owner, typename Enumeration>
  void word(std::string_view name, Enumeration Owner::*member, std::vector<std::string_view> words,
            std::string_view description, bool is_required = false) {
    KeyDescription& key = add_row(name, std::string(), {}, {"", "", description, is_required});
    key.type = ValueType::word;
    key.words = words;
    key.get = [part = part_, words, member](const Scene& scene) -> std::optional<Value> {
      return Value(std::string(words.at(static_cast<std::size_t>(part(scene).*member))));
    };
    key.set = [part = part_, words, member](Scene& scene, const Value& value) {
      const auto found = std::ranges::find(words, std::get<std::string>(value));
      part(scene).*member = static_cast<Enumeration>(found - words.begin());
    };
  }

 private:
  KeyDescription& add_row(std::string_view name, Value stored_as, Range range, const RowText& text) {
    KeyDescription& key = rows_->keys.emplace_back();
    key.table = table_.name;
    key.name = name;
    key.type = static_cast<ValueType>(stored_as.index());
    key.stored_as = std::move(stored_as);
    key.symbol = text.symbol;
    key.unit = text.unit;
    key.range = range;
    key.kinds = kinds_;
    key.required = text.is_required;
    key.description = text.description;
    return key;
  }

  SchemaRows* rows_;
  TableDescription table_;
  Part part_;
  std::vector<std::string_view> kinds_;
};

}  // namespace vehd
