// SPDX-License-Identifier: GPL-2.0-or-later
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "keys/mesh_file.hpp"
#include "support/refusal.hpp"

namespace solidem::mesh_files_test {

class MeshFiles : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ + "/" + name, std::ios::binary) << text;
    return folder_ + "/" + name;
  }
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static std::string refusal(const std::string& path) {
    return test::refusal_of([&] { read_closed_mesh(path, 1); });
  }

  std::string folder_ = testing::TempDir() + "mesh_files";
};

// A tetrahedron with three edges of a tenth along the axes.
const char corners[4][16] = {"0 0 0", "0.1 0 0", "0 0.1 0", "0 0 0.1"};
const int facets[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string stl(int count = 4) {
  std::string text = "solid tetrahedron\n";
  for (int f = 0; f < count; ++f) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int v : facets[f]) text += std::string("vertex ") + corners[v] + "\n";
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid tetrahedron\n";
}

std::string obj() {
  std::string text = "# a tetrahedron\no one\n";
  for (const auto& corner : corners) text += std::string("v ") + corner + "\n";
  text += "vn 0 0 1\n";
  for (const auto& [a, b, c] : facets)
    text += "f " + std::to_string(a + 1) + "//1 " + std::to_string(b + 1) + "//1 " +
            std::to_string(c + 1) + "//1\n";
  return text;
}

std::string ply() {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
      "property double z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& corner : corners) text += std::string(corner) + "\n";
  for (const auto& [a, b, c] : facets)
    text += "3 " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
  return text;
}

std::string binary_stl() {
  const float places[4][3] = {{0, 0, 0}, {0.125F, 0, 0}, {0, 0.125F, 0}, {0, 0, 0.125F}};
  std::string text(80, ' ');
  const std::uint32_t count = 4;
  text.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& facet : facets) {
    text.append(12, '\0');
    for (const int v : facet) text.append(reinterpret_cast<const char*>(places[v]), 12);
    text.append(2, '\0');
  }
  return text;
}

TEST_F(MeshFiles, TextKeepsAllDigitsInEachFormat) {
  for (const auto& [name, text] : {std::pair<std::string, std::string>{"a.stl", stl()},
                                   {"b.obj", obj()},
                                   {"c.ply", ply()},
                                   {"D.STL", stl()}}) {
    const TriangleMesh mesh = read_closed_mesh(write(name, text), 1e-3);
    EXPECT_EQ(mesh.vertices.size(), 4U) << name;
    EXPECT_EQ(mesh.facets.size(), 4U) << name;
    EXPECT_NEAR(volume(mesh), 1e-12 / 6, 1e-26) << name;
    EXPECT_EQ(bounds(mesh).second.x, 1e-3 * 0.1) << name;
  }
}

TEST_F(MeshFiles, ABinaryFileIsReadAsWell) {
  const TriangleMesh mesh = read_closed_mesh(write("a.stl", binary_stl()), 1);
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_NEAR(volume(mesh), 0.125 * 0.125 * 0.125 / 6, 1e-17);
}

TEST_F(MeshFiles, PolygonsAreSplitIntoTriangles) {
  const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  EXPECT_EQ(read_mesh(write("square.obj", square), 1).facets.size(), 2U);
}

TEST_F(MeshFiles, WhatIsNoMeshIsRefusedByName) {
  EXPECT_NE(refusal(folder_ + "/none.stl").find("none.stl: cannot be read (No such file"),
            std::string::npos);
  EXPECT_NE(refusal(folder_).find("is a folder"), std::string::npos);
  EXPECT_NE(
      refusal(write("a.step", stl())).find("expected a file that ends with .stl, .obj or .ply"),
      std::string::npos);
  EXPECT_NE(refusal(write("a.ply", "nothing of the kind")).find("is no mesh"), std::string::npos);
  EXPECT_NE(refusal(write("a.stl", "")).find("a.stl: "), std::string::npos);
  EXPECT_NE(refusal(write("a.obj", obj() + "f 1 2 9\n")).find("is no mesh"), std::string::npos);
}

TEST_F(MeshFiles, EveryFileCutShortIsRefused) {
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>{"a.stl", binary_stl()}, {"c.ply", ply()}})
    for (std::size_t length = 0; length + 3 < text.size(); length += 7)
      EXPECT_NE(refusal(write(name, text.substr(0, length))), "") << name << " " << length;
}

TEST_F(MeshFiles, AnOpenMeshIsNoBody) {
  const std::string path = write("open.stl", stl(3));
  EXPECT_EQ(read_mesh(path, 1).facets.size(), 3U);
  const std::string refused = refusal(path);
  EXPECT_NE(refused.find("open.stl: is not closed: facet 1 has no neighbour"), std::string::npos)
      << refused;
}

}  // namespace solidem::mesh_files_test
