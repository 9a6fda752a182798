// SPDX-License-Identifier: GPL-2.0-or-later
//
// Trajectories: the whole body at a few moments, as HDF5 with an XDMF index beside it.
//
//   trajectory/rest.h5       /elements/position (N,3), /elements/radius (N)  at rest, m
//                            /elements/body (N)       number from 0, only if there are several
//                            /elements/index (N)      only if points are drawn
//                            /bonds/pairs (B,2)       absent without bonds
//   trajectory/000000.h5 ... attributes step, time; one dataset (N) or (N,c) per field; in a group
//                            bonds, one (B) or (B,c) per field of the bonds; in groups tools/NAME
//                            vertices (V,3), m, and facets (F,3), where there are tools
//   trajectory.h5            all of it in one, by links: /elements, /bonds, /frames/000000 ...
//   trajectory.xdmf          what ParaView opens: one grid for each frame, lines along the bonds
//                            (points where there are none or the body is periodic), every field and
//                            the radius at the elements; a grid for each tool beside it
//
// Each file is written whole and then never changed, or replaced in one step: all can be opened
// while the run goes on and after it was killed. They end with a seal (output/seal.hpp).
#ifndef SOLIDEM_OUTPUT_TRAJECTORY_HPP
#define SOLIDEM_OUTPUT_TRAJECTORY_HPP

#include <array>
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

/// A surface of triangles beside the body.
struct DrawnSurface {
  std::string name;
  const std::vector<Vector>& vertices;                     ///< m
  const std::vector<std::array<std::int32_t, 3>>& facets;  ///< indices of vertices
};

/// Writes a trajectory, frame by frame.
class TrajectoryWriter {
 public:
  /// Starts a new trajectory in the place of an earlier one, and its index beside it (extension
  /// .xdmf). `run` is the identity of the run, for resume. RunError if it cannot be written.
  TrajectoryWriter(const std::string& path, const Specimen& specimen, std::string run = "");

  /// Goes on with the trajectory of an earlier run after `step`. Frames of later steps are dropped;
  /// those that are damaged, or of another run, are set aside under another name, and an index that
  /// is missing or damaged is written anew. InputError if it is of another specimen.
  static TrajectoryWriter resume(const std::string& path, const Specimen& specimen,
                                 std::int64_t step, std::string run = "");

  /// Adds a frame. When it returns, file and index hold it and are on the disk. RunError names the
  /// file, the reason and the frames that are safe: a full disk costs only this frame.
  void write_frame(std::int64_t step, double time, const std::vector<Field>& fields,
                   const std::vector<DrawnSurface>& surfaces = {});

  /// What resume found damaged, a sentence each.
  const std::vector<std::string>& notes() const { return notes_; }

  std::size_t frames() const { return frames_.size(); }

 private:
  struct FrameField {
    std::string name;
    std::size_t components;
    bool of_bonds;
  };
  struct FrameSurface {
    std::string name;
    std::size_t vertices, facets;
  };
  struct Frame {
    std::string name;
    std::int64_t step;
    double time;
    std::vector<FrameField> fields;
    std::vector<FrameSurface> surfaces;
    void sort();  // so that an index is the same whether it was written or read
  };

  struct Continuation {};
  TrajectoryWriter(Continuation, const std::string& path, const Specimen& specimen,
                   std::string run);
  std::string file_of(const std::string& name) const { return folder_ + '/' + name + ".h5"; }
  void start(const Specimen& specimen) const;
  void insist_on_same(const Specimen& specimen);
  bool take_frame(const std::string& name);
  Frame read_frame(const Hdf5Group& group, const std::string& name) const;
  void set_aside(const std::string& name, const std::string& reason);
  std::size_t rows(const FrameField& field) const { return field.of_bonds ? bonds_ : elements_; }
  std::string what_is_safe() const;
  std::string xdmf_of(const Frame& frame) const;
  std::string xdmf_of(const Frame& frame, const FrameSurface& surface) const;
  void write_index() const;

  std::string path_, folder_, run_;
  std::size_t elements_, bonds_, lines_;  // lines drawn: bonds, or 0 to draw points
  bool has_bodies_;
  std::size_t next_ = 0;  // number of the next frame
  std::vector<Frame> frames_;
  std::vector<std::string> notes_;
};

}  // namespace solidem

#endif
