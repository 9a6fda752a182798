// SPDX-License-Identifier: GPL-2.0-or-later
#include "model/model.hpp"

#include <cassert>
#include <stdexcept>
#include <string>

namespace solidem {

Model::Model(Specimen specimen, const std::optional<std::vector<Pair>>& conductors)
    : specimen_(std::move(specimen)),
      bonds_{"bonds", Site::slot, Slots(specimen_.size(), specimen_.bonds)} {
  if (conductors)
    conductors_ = PairTable{"conductors", Site::conductor, Slots(specimen_.size(), *conductors)};
  std::vector<Pair>().swap(specimen_.bonds);  // assigning {} would keep its memory
  assert(slots().is_symmetric() && this->conductors().is_symmetric());
}

std::size_t Model::size(const Column& column) const {
  const std::size_t entries = column.site == Site::element ? slots().padded_elements()
                              : column.site == Site::slot  ? slots().rows() * lanes
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

void Model::lay_out_columns(PairTable& table) {
  ++table.version;
  for (Storage& storage : storage_)
    if (storage.column->site == table.site)
      for (int b = 0; b < storage.column->buffers; ++b)
        storage.buffer[b].assign(size(*storage.column));
}

void Model::replace_slots(const std::vector<std::uint32_t>& first,
                          const std::vector<std::int32_t>& neighbours, std::size_t bonds) {
  bonds_.slots.list(first, neighbours, bonds);
  lay_out_columns(bonds_);
}

PairTable& Model::own_conductors() {
  if (!conductors_) throw std::logic_error("the conductors are the bonds and cannot change apart");
  return *conductors_;
}

void Model::replace_conductors(const std::vector<Pair>& pairs) {
  own_conductors().slots = Slots(elements(), pairs);
  lay_out_columns(own_conductors());
  assert(conductors().is_symmetric());
}

void Model::break_bond(Pair pair, double length) {
  const auto here = slots().find(pair.i, pair.j), there = slots().find(pair.j, pair.i);
  assert(here && there);
  // What shares the table of bonds would lose a pair unawares.
  assert(!has(columns::temperature) || !shares_conductors());
  slots().set_neighbour(*here, pair.i);
  slots().set_neighbour(*there, pair.j);
  ++bonds_.version;
  bond_changes_.push_back({BondChange::Kind::broken, pair, length});
}

bool Model::make_bond(Pair pair, double length) {
  assert(!slots().find(pair.i, pair.j) && !slots().find(pair.j, pair.i));
  const auto here = slots().find(pair.i, pair.i), there = slots().find(pair.j, pair.j);
  if (!here || !there) return false;
  slots().set_neighbour(*here, pair.j);
  slots().set_neighbour(*there, pair.i);
  ++bonds_.version;
  bond_changes_.push_back({BondChange::Kind::made, pair, length});
  return true;
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

void Model::swap(const Column& column, const Column& before) {
  swap(column);
  Storage& storage = require(column);
  std::swap(storage.buffer[1 - storage.current], require(before).buffer[0]);
}

void Model::swap(const Column& column) {
  Storage& storage = require(column);
  storage.current = 1 - storage.current;
}

std::size_t Model::bytes() const {
  std::size_t sum = slots().bytes() + specimen_.position.capacity() * sizeof(Vector) +
                    specimen_.radius.capacity() * sizeof(double) +
                    bond_changes_.capacity() * sizeof(BondChange) +
                    (conductors_ ? conductors_->slots.bytes() : 0);
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
