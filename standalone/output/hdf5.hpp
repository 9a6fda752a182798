// SPDX-License-Identifier: GPL-2.0-or-later
//
// HDF5 files as C++ objects: handles that close themselves, errors that name file and object.
// Reading throws InputError (the file is not what it should be), writing throws RunError.
//
// Files are made in memory and put on the disk whole (replace_hdf5_file): HDF5 itself writes to no
// file, so none of its writes can fail halfway, and no file is ever seen before it is complete.
#ifndef SOLIDEM_OUTPUT_HDF5_HPP
#define SOLIDEM_OUTPUT_HDF5_HPP

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace solidem {

/// A group of an open HDF5 file, or its root. Copies share the same open file, which closes with
/// the last of them. Element types are double, float, std::int32_t, std::int64_t and std::uint8_t;
/// the file may hold another numeric type, HDF5 converts. Names may be paths ("elements/position").
class Hdf5Group {
 public:
  /// Is there a dataset or a group, or an attribute, of this name?
  bool has(const std::string& name) const;
  bool has_attribute(const std::string& name) const;

  /// Names of all datasets and groups, or of all attributes, in alphabetic order.
  std::vector<std::string> names() const;
  std::vector<std::string> attribute_names() const;

  /// Opens a group; makes one, with its parents.
  Hdf5Group group(const std::string& name) const;
  Hdf5Group make_group(const std::string& name) const;

  /// Makes a link to an object of another file, named as seen from the folder of this one.
  void link(const std::string& name, const std::string& file, const std::string& object) const;

  /// Extents of a dataset.
  std::vector<std::size_t> shape(const std::string& name) const;

  /// A whole dataset, rows one after the other. `read` with `rows` and `columns` insists on the
  /// shape (rows, columns), or (rows) when columns is 0; any number of rows when rows is
  /// `any_rows`.
  static constexpr std::size_t any_rows = static_cast<std::size_t>(-1);
  template <class T>
  std::vector<T> read(const std::string& name, std::size_t rows = any_rows,
                      std::size_t columns = 0) const;

  /// Writes a dataset of the given extents from contiguous memory.
  template <class T>
  void write(const std::string& name, const T* values, const std::vector<std::size_t>& shape) const;
  template <class T>
  void write(const std::string& name, const std::vector<T>& values) const {
    write(name, values.data(), {values.size()});
  }

  /// Attributes: a number, numbers, or text; setting replaces.
  void set_attribute(const std::string& name, double value) const;
  void set_attribute(const std::string& name, std::int64_t value) const;
  void set_attribute(const std::string& name, int value) const {
    set_attribute(name, static_cast<std::int64_t>(value));
  }
  void set_attribute(const std::string& name, const std::string& value) const;
  void set_attribute(const std::string& name, const char* value) const {
    set_attribute(name, std::string(value));
  }
  template <class T>
  void set_attribute(const std::string& name, const std::vector<T>& values) const;
  double number_attribute(const std::string& name) const;
  std::int64_t integer_attribute(const std::string& name) const;
  std::string text_attribute(const std::string& name) const;
  /// All numbers of an attribute; exactly `count` of them unless count is 0.
  std::vector<double> numbers_attribute(const std::string& name, std::size_t count = 0) const;

  /// Attributes of a dataset or group inside this group ("." is the group itself).
  Hdf5Group object(const std::string& name) const;

  /// Where this is, for messages: file and path inside it.
  const std::string& where() const { return where_; }

 protected:
  using Handle = std::shared_ptr<std::int64_t>;  // an hid_t that knows how to close
  Hdf5Group(Handle file, Handle group, std::string where)
      : file_(std::move(file)), group_(std::move(group)), where_(std::move(where)) {}
  std::int64_t id() const { return *group_; }
  void insist_there_is(const std::string& name) const;
  [[noreturn]] void fail_reading(const std::string& name, const std::string& what) const;
  [[noreturn]] void fail_writing(const std::string& name) const;

  Handle file_, group_;
  std::string where_;
};

/// Whether a file ends with a seal (output/seal.hpp).
enum class Seal { absent, present };

/// An open HDF5 file, itself the root group.
class Hdf5File : public Hdf5Group {
 public:
  /// To read; throws InputError, also where the file has a seal that does not hold. With
  /// Seal::present, it must have one.
  static Hdf5File open(const std::string& path, Seal seal = Seal::absent);
  /// A new file in memory; `path` is for messages. Throws RunError.
  static Hdf5File in_memory(const std::string& path);

  /// Whether the file that was opened ends with a seal; it then holds.
  bool is_sealed() const { return is_sealed_; }

  /// The bytes of a file in memory as they would stand on the disk. They change with the file.
  std::string_view image() const;

  /// Closes; RunError if something that was written is lost. Nothing of this file may be used then.
  void close();

 private:
  Hdf5File(const Handle& file, const std::string& path, bool is_sealed = false);

  bool is_sealed_;
};

/// Writes an HDF5 file whole or not at all, as replace_file does: `fill` makes what is in it.
void replace_hdf5_file(const std::string& path, const std::function<void(const Hdf5File&)>& fill,
                       Seal seal = Seal::absent);

}  // namespace solidem

#endif
