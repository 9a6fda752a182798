// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/hdf5.hpp"

#include <hdf5.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "model/error.hpp"
#include "output/disk.hpp"
#include "output/replace_file.hpp"
#include "output/seal.hpp"

namespace solidem {

static_assert(sizeof(hid_t) == sizeof(std::int64_t), "HDF5 1.10 or later has 64-bit handles");

namespace {

using Handle = std::shared_ptr<std::int64_t>;

template <class Close>
Handle owned(hid_t id, Close close) {
  return Handle(new std::int64_t(id), [close](const std::int64_t* handle) {
    if (*handle >= 0) close(*handle);
    delete handle;
  });
}

/// Closes now. HDF5 may put off to this moment what it was asked to write, so it may fail.
bool is_closed(const Handle& handle, herr_t (*close)(hid_t)) {
  return close(std::exchange(*handle, -1)) >= 0;
}

// No file locks: ParaView or a script may hold a file open while a run replaces it.
// (Property lists live on: closing one would wipe the reason of a failure that is still to be
// told.)
hid_t without_locks() {
  static const Handle list = [] {
    Handle made = owned(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(*made, false, true);
    return made;
  }();
  return *list;
}

/// Files that HDF5 keeps in memory and writes nowhere.
hid_t memory_only() {
  constexpr std::size_t growth = std::size_t{1} << 20;
  static const Handle list = [] {
    Handle made = owned(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_fapl_core(*made, growth, false);
    return made;
  }();
  return *list;
}

// Before any other call to HDF5. Errors are told by exceptions, not by the library's own print on
// the terminal. And the library need not tidy up at exit: our handles close what they opened.
void prepare_library() {
  H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

// The system's reason at the bottom of HDF5's error stack, as in "error message = 'No space left on
// device'"; else the innermost description.
std::string reason() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t* error, void* data) -> herr_t {
        auto& found = *static_cast<std::string*>(data);
        if (error->desc && found.empty()) found = error->desc;
        return 0;
      },
      &text);
  const std::string mark = "error message = '";
  const auto begin = text.find(mark);
  if (begin == std::string::npos) return text.empty() ? "unknown error of HDF5" : text;
  const auto end = text.find('\'', begin + mark.size());
  return text.substr(begin + mark.size(), end - begin - mark.size());
}

template <class T>
hid_t memory_type();
template <>
hid_t memory_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t memory_type<float>() {
  return H5T_NATIVE_FLOAT;
}
template <>
hid_t memory_type<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t memory_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t memory_type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

Handle dataspace(const std::vector<std::size_t>& shape) {
  const std::vector<hsize_t> extents(shape.begin(), shape.end());
  return owned(H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr),
               H5Sclose);
}

hid_t parents_too() {
  static const Handle list = [] {
    Handle made = owned(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
    H5Pset_create_intermediate_group(*made, 1);
    return made;
  }();
  return *list;
}

/// Datasets do not say when they were made, so that equal contents are equal files.
hid_t without_times() {
  static const Handle list = [] {
    Handle made = owned(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_obj_track_times(*made, false);
    return made;
  }();
  return *list;
}

std::string as_text(const std::vector<std::size_t>& shape) {
  std::string text = "(";
  for (std::size_t k = 0; k < shape.size(); ++k) text += (k ? ", " : "") + std::to_string(shape[k]);
  return text + ")";
}

std::vector<std::size_t> extents_of(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> extents(rank > 0 ? static_cast<std::size_t>(rank) : 0);
  if (rank > 0) H5Sget_simple_extent_dims(space, extents.data(), nullptr);
  return {extents.begin(), extents.end()};
}

bool is_numeric(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

}  // namespace

void Hdf5Group::fail_reading(const std::string& name, const std::string& what) const {
  throw InputError(where_ + (where_.back() == '/' ? "" : "/") + name + ": " + what);
}

void Hdf5Group::fail_writing(const std::string& name) const {
  throw RunError("cannot write " + where_ + (where_.back() == '/' ? "" : "/") + name + ": " +
                 reason());
}

bool Hdf5Group::has(const std::string& name) const {
  // H5Lexists is an error, not a no, when a parent is missing: ask for every level.
  for (std::size_t slash = name.find('/', 1);; slash = name.find('/', slash + 1)) {
    const htri_t is_there = H5Lexists(id(), name.substr(0, slash).c_str(), H5P_DEFAULT);
    if (is_there < 0) fail_reading(name, "cannot be looked for (" + reason() + ")");
    if (is_there == 0) return false;
    if (slash == std::string::npos) return true;
  }
}

bool Hdf5Group::has_attribute(const std::string& name) const {
  return H5Aexists(id(), name.c_str()) > 0;
}

void Hdf5Group::insist_there_is(const std::string& name) const {
  if (!has(name)) fail_reading(name, "missing in the file");
}

std::vector<std::string> Hdf5Group::names() const {
  std::vector<std::string> found;
  const herr_t done = H5Literate(
      id(), H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t, const char* name, const H5L_info_t*, void* data) -> herr_t {
        static_cast<std::vector<std::string>*>(data)->emplace_back(name);
        return 0;
      },
      &found);
  if (done < 0) fail_reading("", "cannot be listed (" + reason() + ")");
  return found;
}

std::vector<std::string> Hdf5Group::attribute_names() const {
  std::vector<std::string> found;
  const herr_t done = H5Aiterate2(
      id(), H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t, const char* name, const H5A_info_t*, void* data) -> herr_t {
        static_cast<std::vector<std::string>*>(data)->emplace_back(name);
        return 0;
      },
      &found);
  if (done < 0) fail_reading("", "cannot be listed (" + reason() + ")");
  return found;
}

Hdf5Group Hdf5Group::object(const std::string& name) const {
  if (name != ".") insist_there_is(name);
  Handle handle = owned(H5Oopen(id(), name.c_str(), H5P_DEFAULT), H5Oclose);
  if (*handle < 0) fail_reading(name, "cannot be opened (" + reason() + ")");
  return {file_, handle, where_ + (where_.back() == '/' ? "" : "/") + name};
}

Hdf5Group Hdf5Group::group(const std::string& name) const {
  insist_there_is(name);
  Handle handle = owned(H5Gopen2(id(), name.c_str(), H5P_DEFAULT), H5Gclose);
  if (*handle < 0) fail_reading(name, "is no group");
  return {file_, handle, where_ + (where_.back() == '/' ? "" : "/") + name};
}

Hdf5Group Hdf5Group::make_group(const std::string& name) const {
  Handle handle =
      owned(H5Gcreate2(id(), name.c_str(), parents_too(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  if (*handle < 0) fail_writing(name);
  return {file_, handle, where_ + (where_.back() == '/' ? "" : "/") + name};
}

void Hdf5Group::link(const std::string& name, const std::string& file,
                     const std::string& object) const {
  if (H5Lcreate_external(file.c_str(), object.c_str(), id(), name.c_str(), parents_too(),
                         H5P_DEFAULT) < 0)
    fail_writing(name);
}

std::vector<std::size_t> Hdf5Group::shape(const std::string& name) const {
  insist_there_is(name);
  const Handle set = owned(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (*set < 0) fail_reading(name, "is no dataset");
  const Handle space = owned(H5Dget_space(*set), H5Sclose);
  return extents_of(*space);
}

template <class T>
std::vector<T> Hdf5Group::read(const std::string& name, std::size_t rows,
                               std::size_t columns) const {
  const std::vector<std::size_t> found = shape(name);
  const bool fits = found.size() == (columns ? 2u : 1u) && (rows == any_rows || found[0] == rows) &&
                    (!columns || found[1] == columns);
  if (!fits) {
    const std::string wanted_rows = rows == any_rows ? "any" : std::to_string(rows);
    fail_reading(name, "has shape " + as_text(found) + ", expected (" + wanted_rows +
                           (columns ? ", " + std::to_string(columns) : "") + ")");
  }
  const Handle set = owned(H5Dopen2(id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  const Handle type = owned(H5Dget_type(*set), H5Tclose);
  if (!is_numeric(*type)) fail_reading(name, "does not hold numbers");
  // A damaged extent must not ask for all memory.
  const double bytes = static_cast<double>(found[0]) * static_cast<double>(columns ? columns : 1) *
                       static_cast<double>(H5Tget_size(*type));
  if (bytes > static_cast<double>(H5Dget_storage_size(*set)))
    fail_reading(name, "has shape " + as_text(found) + ", more than the file holds of it");
  std::vector<T> values(found[0] * (columns ? columns : 1));
  if (!values.empty() &&
      H5Dread(*set, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail_reading(name, "cannot be read, the file is damaged (" + reason() + ")");
  return values;
}

template <class T>
void Hdf5Group::write(const std::string& name, const T* values,
                      const std::vector<std::size_t>& shape) const {
  const Handle space = dataspace(shape);
  const Handle set = owned(H5Dcreate2(id(), name.c_str(), memory_type<T>(), *space, parents_too(),
                                      without_times(), H5P_DEFAULT),
                           H5Dclose);
  if (*set < 0) fail_writing(name);
  const bool empty = std::find(shape.begin(), shape.end(), std::size_t{0}) != shape.end();
  if (!empty && H5Dwrite(*set, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    fail_writing(name);
  if (!is_closed(set, H5Dclose)) fail_writing(name);
}

namespace {

// Makes the attribute anew and fills it; false when HDF5 refuses.
bool put_attribute(hid_t object, const std::string& name, hid_t type, hid_t space,
                   const void* values) {
  if (H5Aexists(object, name.c_str()) > 0 && H5Adelete(object, name.c_str()) < 0) return false;
  const Handle attribute =
      owned(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  return *attribute >= 0 && H5Awrite(*attribute, type, values) >= 0 &&
         is_closed(attribute, H5Aclose);
}

}  // namespace

void Hdf5Group::set_attribute(const std::string& name, double value) const {
  const Handle space = owned(H5Screate(H5S_SCALAR), H5Sclose);
  if (!put_attribute(id(), name, H5T_NATIVE_DOUBLE, *space, &value)) fail_writing(name);
}

void Hdf5Group::set_attribute(const std::string& name, std::int64_t value) const {
  const Handle space = owned(H5Screate(H5S_SCALAR), H5Sclose);
  if (!put_attribute(id(), name, H5T_NATIVE_INT64, *space, &value)) fail_writing(name);
}

void Hdf5Group::set_attribute(const std::string& name, const std::string& value) const {
  const Handle space = owned(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle type = owned(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(*type, H5T_VARIABLE);
  H5Tset_cset(*type, H5T_CSET_UTF8);
  const char* text = value.c_str();
  if (!put_attribute(id(), name, *type, *space, &text)) fail_writing(name);
}

template <class T>
void Hdf5Group::set_attribute(const std::string& name, const std::vector<T>& values) const {
  const Handle space = dataspace({values.size()});
  if (!put_attribute(id(), name, memory_type<T>(), *space, values.data())) fail_writing(name);
}

std::vector<double> Hdf5Group::numbers_attribute(const std::string& name, std::size_t count) const {
  const std::string label = "attribute " + name;
  if (!has_attribute(name)) fail_reading(label, "missing in the file");
  const Handle attribute = owned(H5Aopen(id(), name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle space = owned(H5Aget_space(*attribute), H5Sclose);
  const Handle type = owned(H5Aget_type(*attribute), H5Tclose);
  if (!is_numeric(*type)) fail_reading(label, "is no number");
  const hssize_t points = H5Sget_simple_extent_npoints(*space);
  if (static_cast<double>(points) * static_cast<double>(H5Tget_size(*type)) >
      static_cast<double>(H5Aget_storage_size(*attribute)))
    fail_reading(label, "claims more values than it has");
  std::vector<double> values(points > 0 ? static_cast<std::size_t>(points) : 0);
  if (count && values.size() != count)
    fail_reading(label, "has " + std::to_string(values.size()) + " values, expected " +
                            std::to_string(count));
  if (!values.empty() && H5Aread(*attribute, H5T_NATIVE_DOUBLE, values.data()) < 0)
    fail_reading(label, "cannot be read (" + reason() + ")");
  return values;
}

double Hdf5Group::number_attribute(const std::string& name) const {
  return numbers_attribute(name, 1)[0];
}

std::int64_t Hdf5Group::integer_attribute(const std::string& name) const {
  numbers_attribute(name, 1);  // its checks; the value itself would lose digits beyond 2^53
  const Handle attribute = owned(H5Aopen(id(), name.c_str(), H5P_DEFAULT), H5Aclose);
  std::int64_t value = 0;
  if (H5Aread(*attribute, H5T_NATIVE_INT64, &value) < 0)
    fail_reading("attribute " + name, "cannot be read (" + reason() + ")");
  return value;
}

std::string Hdf5Group::text_attribute(const std::string& name) const {
  const std::string label = "attribute " + name;
  if (!has_attribute(name)) fail_reading(label, "missing in the file");
  const Handle attribute = owned(H5Aopen(id(), name.c_str(), H5P_DEFAULT), H5Aclose);
  const Handle type = owned(H5Aget_type(*attribute), H5Tclose);
  const Handle space = owned(H5Aget_space(*attribute), H5Sclose);
  if (H5Tget_class(*type) != H5T_STRING || H5Sget_simple_extent_npoints(*space) != 1)
    fail_reading(label, "is no text");
  if (H5Tis_variable_str(*type) > 0) {
    char* text = nullptr;
    if (H5Aread(*attribute, *type, &text) < 0 || !text)
      fail_reading(label, "cannot be read (" + reason() + ")");
    std::string value = text;
    H5free_memory(text);
    return value;
  }
  std::vector<char> text(H5Tget_size(*type) + 1, '\0');
  if (H5Aread(*attribute, *type, text.data()) < 0)
    fail_reading(label, "cannot be read (" + reason() + ")");
  return text.data();
}

Hdf5File::Hdf5File(const Handle& file, const std::string& path, bool is_sealed)
    : Hdf5Group(file, file, path + ":/"), is_sealed_(is_sealed) {}

namespace {

/// Whether there is a seal. What is damaged is not for HDF5 to take apart, which need not survive
/// it.
bool insist_on_seal(const std::string& path, Seal seal) {
  const SealState found = check_seal(path);
  if (found == SealState::broken)
    throw InputError(path +
                     ": is damaged, its bytes are not those that were written (the seal at its end "
                     "does not fit)");
  if (found == SealState::absent && seal == Seal::present)
    throw InputError(
        path +
        ": has no seal at its end: it is cut short, was changed by another program, or "
        "is of an earlier version of solidem");
  return found == SealState::holds;
}

}  // namespace

Hdf5File Hdf5File::open(const std::string& path, Seal seal) {
  prepare_library();
  if (!is_there(path)) throw InputError(path + ": there is no such file");
  if (is_folder(path)) throw InputError(path + ": is a directory, expected an HDF5 file");
  const bool is_sealed = insist_on_seal(path, seal);
  const Handle file = owned(H5Fopen(path.c_str(), H5F_ACC_RDONLY, without_locks()), H5Fclose);
  if (*file >= 0) return {file, path, is_sealed};
  const std::string why = reason();
  if (why.find("truncated") != std::string::npos)
    throw InputError(path + ": the file is cut short (" + why + "); copy or write it again");
  if (why.find("signature") != std::string::npos) throw InputError(path + ": is no HDF5 file");
  throw InputError(path + ": cannot be opened (" + why + ")");
}

Hdf5File Hdf5File::in_memory(const std::string& path) {
  prepare_library();
  const Handle file =
      owned(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, memory_only()), H5Fclose);
  if (*file < 0) throw RunError("cannot make " + path + " in memory: " + reason());
  return {file, path};
}

std::string_view Hdf5File::image() const {
  void** bytes = nullptr;
  if (H5Fflush(*file_, H5F_SCOPE_GLOBAL) >= 0) {
    const ssize_t size = H5Fget_file_image(*file_, nullptr, 0);
    if (size > 0 && H5Fget_vfd_handle(*file_, H5P_DEFAULT, reinterpret_cast<void**>(&bytes)) >= 0)
      return {static_cast<const char*>(*bytes), static_cast<std::size_t>(size)};
  }
  throw RunError("cannot make " + where_ + " in memory: " + reason());
}

void Hdf5File::close() {
  if (!is_closed(file_, H5Fclose)) throw RunError("cannot write " + where_ + ": " + reason());
}

void replace_hdf5_file(const std::string& path, const std::function<void(const Hdf5File&)>& fill,
                       Seal seal) {
  const Hdf5File file = Hdf5File::in_memory(path);
  fill(file);
  const std::string_view content = file.image();
  if (seal == Seal::absent) return replace_file(path, {content});
  replace_file(path, {content, seal_of(content)});
}

#define SOLIDEM_HDF5_TYPE(T)                                                                       \
  template std::vector<T> Hdf5Group::read<T>(const std::string&, std::size_t, std::size_t) const;  \
  template void Hdf5Group::write<T>(const std::string&, const T*, const std::vector<std::size_t>&) \
      const;                                                                                       \
  template void Hdf5Group::set_attribute<T>(const std::string&, const std::vector<T>&) const;
SOLIDEM_HDF5_TYPE(double)
SOLIDEM_HDF5_TYPE(float)
SOLIDEM_HDF5_TYPE(std::int32_t)
SOLIDEM_HDF5_TYPE(std::int64_t)
SOLIDEM_HDF5_TYPE(std::uint8_t)
#undef SOLIDEM_HDF5_TYPE

}  // namespace solidem
