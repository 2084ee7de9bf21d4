#pragma once

#include <concepts>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "bie/support/types.hpp"

/// Values as consecutive bytes, for processes of one program on machines of one kind.
///
/// A type that owns memory lists its members: visit_members(value, visit) calls visit(member, member, …) once.
namespace vehd {

/// Types without memory elsewhere: numbers, matrices of fixed size, structs of these.
template <typename T>
concept Flat = std::is_trivially_destructible_v<T> && !std::is_pointer_v<T>;

/// Matrices of dynamic size.
template <typename T>
concept ResizableMatrix = !Flat<T> && std::derived_from<T, Eigen::PlainObjectBase<T>>;

/// T or const T: visit_members takes both.
template <typename Value, typename T>
concept MaybeConst = std::same_as<std::remove_const_t<Value>, T>;

/// Packs values.
class Packing {
 public:
  template <typename... Values>
  void operator()(const Values&... values) {
    (put(values), ...);
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  template <Flat T>
  void put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void put(const std::string& text) {
    put(text.size());
    bytes_ += text;
  }
  template <ResizableMatrix T>
  void put(const T& matrix) {
    put(matrix.rows());
    put(matrix.cols());
    bytes_.append(reinterpret_cast<const char*>(matrix.data()),
                  sizeof(double) * static_cast<std::size_t>(matrix.size()));
  }
  template <typename T>
  void put(const std::vector<T>& values) {
    put(values.size());
    for (const T& value : values) put(value);
  }
  template <typename Key, typename Value>
  void put(const std::map<Key, Value>& values) {
    put(values.size());
    for (const auto& [key, value] : values) (*this)(key, value);
  }
  template <typename T>
  requires(!Flat<T> && !ResizableMatrix<T>) void put(const T& value) { visit_members(value, *this); }

  std::string bytes_;
};

/// Unpacks values in the order in which they were packed.
class Unpacking {
 public:
  /// @param bytes  must outlive this
  explicit Unpacking(const std::string& bytes) : bytes_(bytes) {}

  /// @throws std::logic_error if too few bytes are left
  template <typename... Values>
  void operator()(Values&... values) {
    (get(values), ...);
  }
  [[nodiscard]] bool is_empty() const { return first_ == bytes_.size(); }

 private:
  const char* next(std::size_t size) {
    if (size > bytes_.size() - first_) throw std::logic_error("less was sent than is expected");
    return bytes_.data() + std::exchange(first_, first_ + size);
  }
  template <Flat T>
  void get(T& value) {
    std::memcpy(static_cast<void*>(&value), next(sizeof value), sizeof value);
  }
  void get(std::string& text) {
    std::size_t size = 0;
    get(size);
    text.assign(next(size), size);
  }
  template <ResizableMatrix T>
  void get(T& matrix) {
    Index rows = 0, cols = 0;
    (*this)(rows, cols);
    matrix.resize(rows, cols);
    const std::size_t size = sizeof(double) * static_cast<std::size_t>(matrix.size());
    // The data pointer of an empty matrix may be null.
    if (size > 0) std::memcpy(matrix.data(), next(size), size);
  }
  template <typename T>
  void get(std::vector<T>& values) {
    std::size_t size = 0;
    get(size);
    values.resize(size);
    for (T& value : values) get(value);
  }
  template <typename Key, typename Value>
  void get(std::map<Key, Value>& values) {
    std::size_t size = 0;
    get(size);
    values.clear();
    for (; size > 0; --size) {
      Key key;
      get(key);
      get(values[key]);
    }
  }
  template <typename T>
  requires(!Flat<T> && !ResizableMatrix<T>) void get(T& value) { visit_members(value, *this); }

  const std::string& bytes_;
  std::size_t first_ = 0;
};

template <typename T>
std::string packed(const T& value) {
  Packing packing;
  packing(value);
  return packing.take();
}

template <typename T>
T unpacked(const std::string& bytes) {
  T value{};
  Unpacking unpacking(bytes);
  unpacking(value);
  return value;
}

}  // namespace vehd
