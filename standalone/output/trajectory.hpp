// SPDX-License-Identifier: GPL-2.0-or-later
//
// Trajectories: the whole body at a few moments, as HDF5 with an XDMF index beside it.
//
//   trajectory.h5    /elements/position (N,3), /elements/radius (N)          at rest, m
//                    /elements/index (N)                                     only if points are
//                    drawn /bonds/pairs (B,2)                                      absent without
//                    bonds /frames/000000 ...  attributes step, time; one dataset (N) or (N,c) per
//                    field; in a group bonds, one (B) or (B,c) per field of the bonds
//   trajectory.xdmf  what ParaView opens: one grid for each frame, lines along the bonds (points
//   where
//                    there are none or the body is periodic), every field and the radius at the
//                    elements
//
// Both can be opened while the run goes on and after it was killed.
#ifndef SOLIDEM_OUTPUT_TRAJECTORY_HPP
#define SOLIDEM_OUTPUT_TRAJECTORY_HPP

#include <cstdint>
#include <string>
#include <vector>

#include "model/specimen.hpp"
#include "output/hdf5.hpp"

namespace solidem {

/// A quantity of each element, or of each bond of the specimen. The field "position" of the
/// elements says where they are drawn.
struct Field {
  std::string name;
  int components;        ///< 1 a number, 3 a vector, or any other count
  const double* values;  ///< N (or B) × components, all of an element side by side, SI
  bool of_bonds = false;
};

/// Writes a trajectory, frame by frame.
class TrajectoryWriter {
 public:
  /// Starts a new file in the place of an earlier one, and its index beside it (extension .xdmf).
  /// RunError if it cannot be written; then the earlier one is as it was.
  TrajectoryWriter(const std::string& path, const Specimen& specimen);

  /// Goes on with the file of an earlier run after `step`; frames of later steps are dropped.
  /// InputError if there is no such file or it is of another specimen.
  static TrajectoryWriter resume(const std::string& path, const Specimen& specimen,
                                 std::int64_t step);

  /// Adds a frame. When it returns, file and index hold it. RunError names the file, the reason and
  /// the frames that are safe: space is secured first, so a full disk costs only this frame.
  void write_frame(std::int64_t step, double time, const std::vector<Field>& fields);

  std::size_t frames() const { return frames_.size(); }

 private:
  struct FrameField {
    std::string name;
    std::size_t components;
    bool of_bonds;
  };
  struct Frame {
    std::string name;
    std::int64_t step;
    double time;
    std::vector<FrameField> fields;
  };

  struct Continuation {};
  TrajectoryWriter(Continuation, const std::string& path, const Specimen& specimen);
  Frame read_frame(const Hdf5Group& group, const std::string& name) const;
  std::size_t rows(const FrameField& field) const { return field.of_bonds ? bonds_ : elements_; }
  void insist_on_same(const Specimen& specimen) const;
  std::string what_is_safe() const;
  std::string xdmf_of(const Frame& frame) const;
  void write_index() const;

  std::string path_;
  std::size_t elements_, bonds_, lines_;  // lines drawn: bonds, or 0 to draw points
  Hdf5File file_;
  std::vector<Frame> frames_;
};

}  // namespace solidem

#endif
