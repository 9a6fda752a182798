# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads a trajectory as other programs do: is the XDMF well formed, and does all it points at exist?

Usage: check_xdmf.py FILE.xdmf FRAMES
Prints the times of the frames; exit code 1 and the reason if something is wrong.
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import h5py
import numpy as np


def main(index: Path, frames: int) -> None:
    root = ElementTree.parse(index).getroot()
    collections = root.findall("./Domain/Grid[@CollectionType='Temporal']")
    assert len(collections) == 1, "expected one temporal collection"
    grids = collections[0].findall("Grid")
    assert len(grids) == frames, f"{len(grids)} grids, expected {frames}"
    for grid in grids:
        for item in grid.iter("DataItem"):
            assert item.text
            name, _, path = item.text.strip().partition(":")
            with h5py.File(index.parent / name, "r") as file:
                dataset = file[path]
                shape = tuple(int(extent) for extent in item.attrib["Dimensions"].split())
                assert dataset.shape == shape, f"{path}: {dataset.shape} is not {shape}"
                kind = {"Float": np.floating, "Int": np.integer}[item.attrib["NumberType"]]
                assert np.issubdtype(dataset.dtype, kind), path
                assert dataset.dtype.itemsize == int(item.attrib["Precision"]), path
        assert grid.find("Geometry/DataItem") is not None
        topology = grid.find("Topology")
        assert topology is not None
        if topology.attrib["TopologyType"] == "Polyline":
            item = topology.find("DataItem")
            assert item is not None and item.attrib["Dimensions"].split()[1] == "2"
    print(" ".join(grid.find("Time").attrib["Value"] for grid in grids))


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]))
