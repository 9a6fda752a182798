// SPDX-License-Identifier: GPL-2.0-or-later
#include "solve/statics/stiffness_solver.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <Eigen/OrderingMethods>
#include <map>
#include <numeric>

#include "effects/effect.hpp"
#include "effects/kernels/block_rows.hpp"

namespace solidem {

namespace {

/// A direction counts as resisted by no bond when its stiffness is below this share of the
/// element's largest: far above round-off, far below the bending of a beam 1000 times as long as
/// thick.
constexpr double nothing = 1e-11;

/// Rows in a chunk of a sum: the sum is the same on any number of threads.
constexpr std::size_t chunk = 512;
/// Chunks below which one thread does it all.
constexpr std::size_t least_chunks = 2;

/// Conjugate gradients take about so many iterations for each element of a body's length.
constexpr double iterations_of_length = 10;
/// Time of an iteration for each entry of K, in operations of a factorisation.
constexpr double cost_of_iteration = 0.5;

/// Parts of a body that move as rigid ones in the coarse body: as many as make the fewest
/// iterations for their cost, up to this number, and one for each so many rows of large bodies.
constexpr std::size_t most_parts_of_small = 160, least_rows_of_part = 48, least_rows_beyond = 250;

auto segment(std::vector<double>& v, std::size_t row) {
  return Eigen::Map<Eigen::Matrix<double, 6, 1>>(v.data() + 6 * row);
}
auto segment(const std::vector<double>& v, std::size_t row) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 1>>(v.data() + 6 * row);
}

/// The sum of what each chunk of some rows gives.
template <class Part>
double sum_of_chunks(std::size_t rows, const Part& part_of) {
  std::vector<double> part((rows + chunk - 1) / chunk);
  for_blocks(part.size(), least_chunks, [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) part[c] = part_of(c);
  });
  return std::accumulate(part.begin(), part.end(), 0.0);
}

/// The inner product of a chunk.
double part_of_product(const std::vector<double>& a, const std::vector<double>& b, std::size_t c) {
  using Map = Eigen::Map<const Eigen::VectorXd>;
  const std::size_t from = 6 * chunk * c, count = std::min(6 * chunk, a.size() - from);
  const auto n = static_cast<Eigen::Index>(count);
  return Map(&a[from], n).dot(Map(&b[from], n));
}

double inner_product(const std::vector<double>& a, const std::vector<double>& b) {
  return sum_of_chunks(a.size() / 6, [&](std::size_t c) { return part_of_product(a, b, c); });
}

}  // namespace

StiffnessSolver::StiffnessSolver(const Specimen& specimen, const std::vector<Pair>& bonds,
                                 std::vector<char> held, double length, LinearMethod method)
    : bonds_(bonds), held_(std::move(held)), length_(length), row_of_(specimen.size(), -1) {
  const std::size_t elements = specimen.size();
  std::vector<char> bonded(elements, 0);
  for (const Pair& pair : bonds_)
    bonded[static_cast<std::size_t>(pair.i)] = bonded[static_cast<std::size_t>(pair.j)] = 1;
  for (std::size_t e = 0; e < elements; ++e) {
    char* degree = &held_[6 * e];
    if (bonded[e] == 0) std::fill(degree, degree + 6, char{1});
    if (std::all_of(degree, degree + 6, [](char h) { return h != 0; })) continue;
    row_of_[e] = static_cast<std::int32_t>(element_of_.size());
    element_of_.push_back(static_cast<std::int32_t>(e));
  }
  make_rows();
  choose(method);
  if (!factorised_) make_parts(specimen);
}

void StiffnessSolver::make_rows() {
  const std::size_t rows = element_of_.size();
  const auto row_of = [&](std::int32_t element) {
    return row_of_[static_cast<std::size_t>(element)];
  };
  start_.assign(rows + 1, 0);
  for (std::size_t r = 0; r < rows; ++r) start_[r + 1] = 1;
  for (const Pair& pair : bonds_)
    if (row_of(pair.i) >= 0 && row_of(pair.j) >= 0) {
      ++start_[static_cast<std::size_t>(row_of(pair.i)) + 1];
      ++start_[static_cast<std::size_t>(row_of(pair.j)) + 1];
    }
  for (std::size_t r = 0; r < rows; ++r) start_[r + 1] += start_[r];

  column_.resize(static_cast<std::size_t>(start_[rows]));
  place_.assign(column_.size(), 0);
  block_of_bond_.assign(bonds_.size(), -1);
  std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
  const auto enter = [&](std::int32_t row, std::int32_t column) {
    const std::int32_t at = next[static_cast<std::size_t>(row)]++;
    column_[static_cast<std::size_t>(at)] = column;
    return static_cast<std::size_t>(at);
  };
  for (std::size_t r = 0; r < rows; ++r)
    enter(static_cast<std::int32_t>(r), static_cast<std::int32_t>(r));
  // Blocks stand in the order of the rows in which they are above the diagonal.
  std::vector<std::array<std::size_t, 2>> sides(bonds_.size());
  for (std::size_t b = 0; b < bonds_.size(); ++b) {
    const std::int32_t i = row_of(bonds_[b].i), j = row_of(bonds_[b].j);
    if (i < 0 || j < 0) continue;
    sides[b] = {enter(i, j), enter(j, i)};
    block_of_bond_[b] = 0;
  }
  std::int32_t blocks = 0;
  for (std::size_t r = 0; r < rows; ++r)
    for (std::int32_t k = start_[r]; k < start_[r + 1]; ++k)
      if (column_[static_cast<std::size_t>(k)] >= static_cast<std::int32_t>(r))
        place_[static_cast<std::size_t>(k)] = blocks++;
  for (std::size_t b = 0; b < bonds_.size(); ++b) {
    if (block_of_bond_[b] < 0) continue;
    const auto [above, below] = sides[b];  // of a pair the first has the lower number
    block_of_bond_[b] = place_[above];
    place_[below] = ~place_[above];
  }
  block_ = Buffer<Block>(static_cast<std::size_t>(blocks));
}

void StiffnessSolver::choose(LinearMethod method) {
  factorised_ = method == LinearMethod::factorised;
  if (method == LinearMethod::iterated || element_of_.empty()) return;
  // The elements as a graph, from which the work of eliminating them is known without any number.
  const auto rows = static_cast<Eigen::Index>(element_of_.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(column_.size());
  for (std::size_t r = 0; r < element_of_.size(); ++r)
    for (std::int32_t k = start_[r]; k < start_[r + 1]; ++k)
      entries.emplace_back(static_cast<int>(r), column_[static_cast<std::size_t>(k)], 1.0);
  Eigen::SparseMatrix<double> graph(rows, rows);
  graph.setFromTriplets(entries.begin(), entries.end());
  struct Elimination : Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> {
    double operations() const {
      return (6 * (m_nonZerosPerCol.cast<double>().array() + 1)).square().sum() * 6;
    }
  } elimination;
  elimination.analyzePattern(graph);
  const auto& order = elimination.permutationP().indices();
  order_.assign(order.data(), order.data() + rows);
  if (method == LinearMethod::automatic)
    factorised_ = elimination.operations() < foreseen_iterations() * cost_of_iteration * 36.0 *
                                                 static_cast<double>(column_.size());
}

double StiffnessSolver::foreseen_iterations() const {
  // The body's length in elements, by going from neighbour to neighbour.
  std::vector<std::int32_t> distance(element_of_.size(), -1), queue;
  std::int32_t length = 0;
  for (std::size_t seed = 0; seed < element_of_.size(); ++seed) {
    if (distance[seed] >= 0) continue;
    queue.assign(1, static_cast<std::int32_t>(seed));
    distance[seed] = 0;
    for (std::size_t q = 0; q < queue.size(); ++q) {
      const auto r = static_cast<std::size_t>(queue[q]);
      length = std::max(length, distance[r] + 1);
      for (std::int32_t k = start_[r]; k < start_[r + 1]; ++k) {
        const std::int32_t c = column_[static_cast<std::size_t>(k)];
        if (distance[static_cast<std::size_t>(c)] >= 0) continue;
        distance[static_cast<std::size_t>(c)] = distance[r] + 1;
        queue.push_back(c);
      }
    }
  }
  // Stretching a body takes as many as it is long; bending one, more by its length over its width.
  const double width = std::sqrt(static_cast<double>(element_of_.size()) / length);
  return iterations_of_length * length * std::max(1.0, length / width);
}

void StiffnessSolver::assemble(const std::function<BondTangent(std::size_t)>& tangent_of,
                               double shift) {
  std::fill(block_.begin(), block_.end(), Block::Zero());
  Eigen::Matrix<double, 12, 1> unit = Eigen::Matrix<double, 12, 1>::Ones();
  for (const int k : {3, 4, 5, 9, 10, 11}) unit[k] = 1 / length_;
  // Tangents are made by all threads, a batch at a time, and added in the order of the bonds.
  constexpr std::size_t batch = 2048;
  std::vector<BondTangent, Eigen::aligned_allocator<BondTangent>> tangents(
      std::min(batch, bonds_.size()));
  for (std::size_t from = 0; from < bonds_.size(); from += batch) {
    const std::size_t count = std::min(batch, bonds_.size() - from);
    for_blocks(count, 64, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k)
        tangents[k] = unit.asDiagonal() * tangent_of(from + k) * unit.asDiagonal();
    });
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t b = from + k;
      const std::int32_t i = row_of_[static_cast<std::size_t>(bonds_[b].i)];
      const std::int32_t j = row_of_[static_cast<std::size_t>(bonds_[b].j)];
      const BondTangent& t = tangents[k];
      if (i >= 0) diagonal(static_cast<std::size_t>(i)) += t.topLeftCorner<6, 6>();
      if (j >= 0) diagonal(static_cast<std::size_t>(j)) += t.bottomRightCorner<6, 6>();
      if (block_of_bond_[b] >= 0)
        block_[static_cast<std::size_t>(block_of_bond_[b])] = t.topRightCorner<6, 6>();
    }
  }
  for (std::size_t r = 0; r < element_of_.size(); ++r) diagonal(r).diagonal().array() += shift;
  hold();
  resist_everything();
  factorised_ ? factorise() : assemble_parts();
}

void StiffnessSolver::hold() {
  // Rows and columns of what is held vanish, but for the diagonal.
  for (std::size_t r = 0; r < element_of_.size(); ++r) {
    const char* held_row = &held_[6 * static_cast<std::size_t>(element_of_[r])];
    for (std::int32_t k = start_[r]; k < start_[r + 1]; ++k) {
      const std::int32_t place = place_[static_cast<std::size_t>(k)];
      if (place < 0) continue;
      Block& block = block_[static_cast<std::size_t>(place)];
      const auto c = static_cast<std::size_t>(column_[static_cast<std::size_t>(k)]);
      const char* held_column = &held_[6 * static_cast<std::size_t>(element_of_[c])];
      const double stiffness = block.trace();
      for (int a = 0; a < 6; ++a) {
        if (held_row[a] != 0) block.row(a).setZero();
        if (held_column[a] != 0) block.col(a).setZero();
        if (c == r && held_row[a] != 0) block(a, a) = stiffness;
      }
    }
  }
}

void StiffnessSolver::resist_everything() {
  unresisted_.clear();
  inverse_ = Buffer<Block>(element_of_.size());
  for (std::size_t r = 0; r < element_of_.size(); ++r) {
    Block& block = diagonal(r);
    const double largest = block.diagonal().cwiseAbs().maxCoeff();
    Eigen::LDLT<Block> factor(block);
    if (factor.vectorD().cwiseAbs().minCoeff() < 1e3 * nothing * largest) {
      const Eigen::SelfAdjointEigenSolver<Block> directions(block);
      for (int k = 0; k < 6; ++k) {
        if (std::abs(directions.eigenvalues()[k]) > nothing * largest) continue;
        const Segment along = directions.eigenvectors().col(k);
        unresisted_.push_back({static_cast<std::int32_t>(r), along});
        block += largest * along * along.transpose();
      }
      factor.compute(block);
    }
    inverse_[r] = factor.solve(Block::Identity());
  }
}

void StiffnessSolver::make_parts(const Specimen& specimen) {
  // Rows follow the order of the specimen, in which neighbours are near.
  const std::size_t rows = element_of_.size();
  const std::size_t most_parts = std::max(most_parts_of_small, rows / least_rows_beyond);
  rows_of_part_ = std::max(least_rows_of_part, rows / most_parts + 1);
  parts_ = (rows + rows_of_part_ - 1) / rows_of_part_;
  if (parts_ < 2) parts_ = 0;
  for (std::size_t r = 0; r < rows && parts_ > 0; ++r) {
    const std::int32_t first = element_of_[r - r % rows_of_part_], element = element_of_[r];
    const Vector arm = (1 / length_) * rest_chord(specimen, {first, element});
    arm_.emplace_back(arm.x, arm.y, arm.z);
    free_.emplace_back(Segment::Ones());
    for (int a = 0; a < 6; ++a)
      if (held_[6 * static_cast<std::size_t>(element) + static_cast<std::size_t>(a)] != 0)
        free_.back()[a] = 0;
  }
}

StiffnessSolver::Block StiffnessSolver::rigid_motion(std::size_t row) const {
  const Eigen::Vector3d& arm = arm_[row];
  Block rigid = Block::Identity();
  rigid.topRightCorner<3, 3>() << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;
  return free_[row].asDiagonal() * rigid;
}

void StiffnessSolver::assemble_parts() {
  if (parts_ == 0) return;
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t part = 0; part < parts_; ++part) {
    std::map<std::size_t, Block> row_of_parts;
    const std::size_t end = std::min((part + 1) * rows_of_part_, element_of_.size());
    for (std::size_t r = part * rows_of_part_; r < end; ++r)
      for (std::int32_t k = start_[r]; k < start_[r + 1]; ++k) {
        const auto c = static_cast<std::size_t>(column_[static_cast<std::size_t>(k)]);
        Block& sum = row_of_parts.try_emplace(c / rows_of_part_, Block::Zero()).first->second;
        sum += rigid_motion(r).transpose() * entry(k) * rigid_motion(c);
      }
    // A part that is held, or straight, has motions that meet no resistance.
    Block& diagonal = row_of_parts[part];
    diagonal.diagonal().array() += 1e-8 * diagonal.trace();
    for (const auto& [other, block] : row_of_parts)
      for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b)
          entries.emplace_back(static_cast<int>(6 * part) + a, static_cast<int>(6 * other) + b,
                               block(a, b));
  }
  const auto size = static_cast<Eigen::Index>(6 * parts_);
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  coarse_.compute(matrix);
  coarse_is_positive_ = coarse_.info() == Eigen::Success && coarse_.vectorD().minCoeff() > 0;
}

void StiffnessSolver::add_coarse(const std::vector<double>& residual,
                                 std::vector<double>& z) const {
  if (parts_ == 0 || !coarse_is_positive_) return;
  Eigen::VectorXd load = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(6 * parts_));
  const auto over_parts = [&](const auto& work) {
    for_blocks(parts_, 16, [&](std::size_t first, std::size_t last) {
      for (std::size_t part = first; part < last; ++part)
        for (std::size_t r = part * rows_of_part_;
             r < std::min((part + 1) * rows_of_part_, element_of_.size()); ++r)
          work(static_cast<Eigen::Index>(6 * part), r);
    });
  };
  over_parts([&](Eigen::Index part, std::size_t r) {
    const Segment force = free_[r].cwiseProduct(segment(residual, r));
    load.segment<6>(part) += force;
    load.segment<3>(part + 3) += arm_[r].cross(force.head<3>());
  });
  const Eigen::VectorXd motion = coarse_.solve(load);
  over_parts([&](Eigen::Index part, std::size_t r) {
    Segment moved = motion.segment<6>(part);
    moved.head<3>() -= arm_[r].cross(moved.tail<3>());
    segment(z, r) += free_[r].cwiseProduct(moved);
  });
}

StiffnessSolver::Unresisted StiffnessSolver::unresisted(const Eigen::VectorXd& b) const {
  Unresisted result;
  for (const Direction& direction : unresisted_) {
    const std::int32_t element = element_of_[static_cast<std::size_t>(direction.row)];
    const double load = std::abs(direction.along.dot(b.segment<6>(Eigen::Index{6} * element)));
    if (load > result.load) result = {load, element};
  }
  return result;
}

void StiffnessSolver::factorise() {
  const auto size = static_cast<Eigen::Index>(6 * element_of_.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * column_.size());
  for (std::size_t r = 0; r < element_of_.size(); ++r)
    for (std::int32_t k = start_[r]; k < start_[r + 1]; ++k) {
      const Block block = entry(k);
      const int row = 6 * order_[r];
      const int column = 6 * order_[static_cast<std::size_t>(column_[static_cast<std::size_t>(k)])];
      for (int a = 0; a < 6; ++a)
        for (int c = 0; c < 6; ++c)
          if (row + a >= column + c) entries.emplace_back(row + a, column + c, block(a, c));
    }
  Eigen::SparseMatrix<double> lower(size, size);
  lower.setFromTriplets(entries.begin(), entries.end());
  factor_.compute(lower);
  positive_ = factor_.info() == Eigen::Success && factor_.vectorD().minCoeff() > 0;
}

StiffnessSolver::Result StiffnessSolver::solve(const Eigen::VectorXd& b, Eigen::VectorXd& x,
                                               double tolerance) const {
  Eigen::VectorXd right = b;
  for (Eigen::Index k = 0; k < right.size(); ++k)
    if (held_[static_cast<std::size_t>(k)] != 0) right[k] = 0;
  for (const Direction& direction : unresisted_) {
    auto part =
        right.segment<6>(Eigen::Index{6} * element_of_[static_cast<std::size_t>(direction.row)]);
    part -= direction.along * direction.along.dot(part);
  }
  return factorised_ ? factor_solve(right, x) : iterate(right, x, tolerance);
}

StiffnessSolver::Result StiffnessSolver::factor_solve(const Eigen::VectorXd& b,
                                                      Eigen::VectorXd& x) const {
  Eigen::VectorXd right(static_cast<Eigen::Index>(6 * element_of_.size()));
  for (std::size_t r = 0; r < element_of_.size(); ++r)
    right.segment<6>(Eigen::Index{6} * order_[r]) = b.segment<6>(Eigen::Index{6} * element_of_[r]);
  const Eigen::VectorXd left = factor_.solve(right);
  x.setZero(b.size());
  for (std::size_t r = 0; r < element_of_.size(); ++r)
    x.segment<6>(Eigen::Index{6} * element_of_[r]) = left.segment<6>(Eigen::Index{6} * order_[r]);
  return {1, positive_, left.allFinite()};
}

std::vector<double> StiffnessSolver::gather(const Eigen::VectorXd& all) const {
  std::vector<double> some(6 * element_of_.size());
  for (std::size_t r = 0; r < element_of_.size(); ++r)
    segment(some, r) = all.segment<6>(Eigen::Index{6} * element_of_[r]);
  return some;
}

Eigen::VectorXd StiffnessSolver::scatter(const std::vector<double>& some, Eigen::Index size) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(size);
  for (std::size_t r = 0; r < element_of_.size(); ++r)
    all.segment<6>(Eigen::Index{6} * element_of_[r]) = segment(some, r);
  return all;
}

Eigen::VectorXd StiffnessSolver::product(const Eigen::VectorXd& x) const {
  std::vector<double> image(6 * element_of_.size());
  multiply(gather(x), image);
  return scatter(image, x.size());
}

double StiffnessSolver::largest_stiffness() const {
  double largest = 0;
  for (std::size_t r = 0; r < element_of_.size(); ++r)
    largest = std::max(largest, diagonal(r).diagonal().maxCoeff());
  return largest;
}

void StiffnessSolver::multiply_chunk(std::size_t number, const std::vector<double>& x,
                                     std::vector<double>& y) const {
  const std::size_t first = number * chunk, last = std::min(first + chunk, element_of_.size());
  multiply_rows()({start_.data(), column_.data(), place_.data(), block_.data()->data()}, first,
                  last, x.data(), y.data());
}

void StiffnessSolver::multiply(const std::vector<double>& x, std::vector<double>& y) const {
  for_blocks((element_of_.size() + chunk - 1) / chunk, least_chunks,
             [&](std::size_t first, std::size_t last) {
               for (std::size_t c = first; c < last; ++c) multiply_chunk(c, x, y);
             });
}

StiffnessSolver::Result StiffnessSolver::iterate(const Eigen::VectorXd& b, Eigen::VectorXd& x,
                                                 double tolerance) const {
  // Preconditioned conjugate gradients. Products of what is at hand anyway are taken with it.
  const std::size_t rows = element_of_.size(), size = 6 * rows;
  std::vector<double> left = gather(x), residual = gather(b), image(size), z(size), p(size);
  const double goal = tolerance * std::sqrt(inner_product(residual, residual));
  multiply(left, image);
  const auto over_chunk = [&](std::size_t c, const auto& work) {
    for (std::size_t r = c * chunk; r < std::min((c + 1) * chunk, rows); ++r) work(r);
  };
  // Goes a step along p; returns the square of the residual.
  const auto go = [&](double step) {
    return sum_of_chunks(rows, [&](std::size_t c) {
      over_chunk(c, [&](std::size_t r) {
        segment(left, r) += step * segment(p, r);
        segment(residual, r) -= step * segment(image, r);
        segment(z, r).noalias() = inverse_[r] * segment(residual, r);
      });
      return part_of_product(residual, residual, c);
    });
  };
  for (std::size_t k = 0; k < size; ++k) residual[k] -= image[k];
  double square = go(0);
  add_coarse(residual, z);
  p = z;
  double rz = inner_product(residual, z);
  Result result;
  const int most = 1000 + 20 * static_cast<int>(std::min(size, std::size_t{1000000}));
  while (std::sqrt(square) > goal) {
    const double curvature = sum_of_chunks(rows, [&](std::size_t c) {
      multiply_chunk(c, p, image);
      return part_of_product(p, image, c);
    });
    if (!(curvature > 0) || result.iterations == most) {
      result.converged = false;
      result.positive = curvature > 0;
      if (!result.positive && result.iterations == 0) left = p;
      break;
    }
    ++result.iterations;
    square = go(rz / curvature);
    add_coarse(residual, z);
    const double next = inner_product(residual, z), ratio = next / rz;
    rz = next;
    for_blocks((rows + chunk - 1) / chunk, least_chunks, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = 6 * chunk * first; k < std::min(6 * chunk * last, size); ++k)
        p[k] = z[k] + ratio * p[k];
    });
  }
  x = scatter(left, b.size());
  return result;
}

}  // namespace solidem
