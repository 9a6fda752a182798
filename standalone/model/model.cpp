// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/model.hpp"

#include <stdexcept>
#include <string>

namespace solidem {

Model::Model(Specimen specimen, const std::optional<std::vector<Pair>>& conductors)
    : specimen_(std::move(specimen)), slots_(specimen_.size(), specimen_.bonds) {
  if (conductors) conductors_.emplace(specimen_.size(), *conductors);
  std::vector<Pair>().swap(specimen_.bonds);  // assigning {} would keep its memory
}

std::size_t Model::size(const Column& column) const {
  const std::size_t entries = column.site == Site::element ? slots_.padded_elements()
                              : column.site == Site::slot  ? slots_.rows() * lanes
                                                           : conductors().rows() * lanes;
  return entries * static_cast<std::size_t>(column.components);
}

const Model::Storage* Model::find(const Column& column) const {
  for (const Storage& storage : storage_)
    if (storage.column == &column) return &storage;
  return nullptr;
}

Model::Storage& Model::require(const Column& column) {
  if (const Storage* storage = find(column)) return const_cast<Storage&>(*storage);
  throw std::logic_error(std::string("no effect asked for the column ") + column.name);
}

void Model::add(const Column& column) {
  if (has(column)) return;
  Storage storage{&column, {}, 0};
  for (int b = 0; b < column.buffers; ++b) storage.buffer[b] = Buffer<double>(size(column));
  storage_.push_back(std::move(storage));
}

void Model::replace_slots(Slots slots) {
  slots_ = std::move(slots);
  for (Storage& storage : storage_)
    if (storage.column->site == Site::slot)
      for (int b = 0; b < storage.column->buffers; ++b)
        storage.buffer[b] = Buffer<double>(size(*storage.column));
}

double* Model::data(const Column& column) {
  Storage& storage = require(column);
  return storage.buffer[storage.current].data();
}

const double* Model::data(const Column& column) const {
  return const_cast<Model*>(this)->data(column);
}

double* Model::next(const Column& column) {
  Storage& storage = require(column);
  return storage.buffer[1 - storage.current].data();
}

void Model::swap(const Column& column) {
  Storage& storage = require(column);
  storage.current = 1 - storage.current;
}

std::size_t Model::bytes() const {
  std::size_t sum = slots_.bytes() + specimen_.position.capacity() * sizeof(Vector) +
                    specimen_.radius.capacity() * sizeof(double) +
                    (conductors_ ? conductors_->bytes() : 0);
  for (const Storage& storage : storage_)
    for (const Buffer<double>& buffer : storage.buffer) sum += buffer.size() * sizeof(double);
  return sum;
}

std::vector<const Column*> Model::columns() const {
  std::vector<const Column*> result;
  for (const Storage& storage : storage_) result.push_back(storage.column);
  return result;
}

}  // namespace solidem
