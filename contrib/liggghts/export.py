#!/usr/bin/env -S /usr/bin/python3 -B
# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes what LIGGGHTS reads from a prepared specimen and its scene.

    solidem prepare scene.toml --output prepared.h5
    solidem explain scene.toml --json > explained.json
    contrib/liggghts/export.py prepared.h5 explained.json DIRECTORY

writes DIRECTORY/run.in, a whole script, with what it reads: body.data, and beams.in (bonds,
contacts, tools, grips and motion), central.in (central forces, grips and motion), grains.in (loose
elements, tools and motion) and heat.in, as the scene has beams, central forces, loose elements and
conduction; besides, where the scene has such, toolN.stl (meshes), cells.txt (law voronoi), walls.txt
(exchanges) and sources.txt (heat sources).
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from contrib.explained import parse_parameters  # noqa: E402
from contrib.liggghts.contacts import (Types, differences, friction_lines, full,  # noqa: E402
                                       has_contacts, has_meshes, pair_lines, require_same_law, tool_lines,
                                       tool_places, touch_lines, types_of)
from contrib.prepared import (Beams, CentralForces, Contact, Damage, Floats,  # noqa: E402
                              Grip, Integers, OverTemperature, Parameters, Plasticity,
                              PreparedError, Rupture, Specimen, read_specimen)

#: Of the mean radius: how much farther lists look where there are contacts.
SKIN = 0.2
#: The same under central forces, if the scene asks for less: LIGGGHTS makes its lists slowly.
LEAST_SKIN = 0.75
#: Of a property over temperature that bond_coeff takes.
MOST_POINTS = 16

HEAD = """\
units           si
atom_style      hybrid granular molecular
atom_modify     map array sort 0 0
boundary        {boundary}
newton          off
communicate     single vel yes
special_bonds   lj/coul 1 1 1
read_data       body.data
{styles}timestep        {time_step}
"""
FOOT = """\
thermo          {every}
dump            state all custom {every} state.txt id x y z vx vy vz fx fy fz
dump_modify     state sort id format "%d{columns}"
run             {steps}
"""


def write_data(path: Path, specimen: Specimen, pairs: Integers, density: Floats,
               types: Types | None = None, places: Floats | None = None) -> None:
    """A LIGGGHTS data file with these pairs as bonds; atom numbers are element indices plus one.

    `types`: of atoms, all 1 without; `places`: (P, 3) points that the box must hold besides, m.
    """
    margin = 4 * float(specimen.radius.max())
    held = specimen.position if places is None else np.concatenate([specimen.position, places])
    lower, upper = held.min(axis=0), held.max(axis=0)
    margin += 0.2 * float((upper - lower).max())
    of_element = (np.ones(len(specimen.radius), dtype=np.int64) if types is None
                  else types.of_element)
    low = np.where(specimen.periodic, specimen.lower, lower - margin)
    high = np.where(specimen.periodic, specimen.upper, upper + margin)
    count, bonds = len(specimen.radius), len(pairs)
    most = int(np.bincount(pairs.ravel(), minlength=1).max()) if bonds else 1
    with open(path, "w") as file:
        file.write(f"specimen\n\n{count} atoms\n{bonds} bonds\n"
                   f"{types.count if types else 1} atom types\n1 bond types\n"
                   f"{most} extra bond per atom\n\n")
        for a, b, name in zip(low, high, "xyz"):
            file.write(f"{full(a)} {full(b)} {name}lo {name}hi\n")
        file.write("\nAtoms\n\n")
        for n, (x, r, d) in enumerate(zip(specimen.position, specimen.radius, density)):
            words = " ".join(map(full, (*x, 2 * r, d)))
            file.write(f"{n + 1} {of_element[n]} {words} 1\n")
        if "mechanics/velocity" in specimen.columns:
            file.write("\nVelocities\n\n")
            for n, v in enumerate(specimen.column("mechanics/velocity")):
                file.write(f"{n + 1} {' '.join(map(full, v))} 0 0 0\n")
        if bonds:
            file.write("\nBonds\n\n")
            for n, (i, j) in enumerate(pairs + 1):
                file.write(f"{n + 1} 1 {i} {j}\n")


def bonds_of(specimen: Specimen, parameters: Parameters) -> Integers:
    """Pairs that are bonds in LIGGGHTS: beams and conductors, which must be the same."""
    if parameters.central_forces or parameters.is_loose:
        return np.zeros((0, 2), dtype=np.int64)
    if parameters.beams and parameters.conduction and not np.array_equal(specimen.conductors,
                                                                         specimen.pairs):
        raise PreparedError(f"{specimen.path}: beams and conduction need the same pairs in LIGGGHTS")
    return specimen.conductors if parameters.conduction else specimen.pairs


def sphere_density(specimen: Specimen, explained: dict[str, Any]) -> Floats:
    """(N,) densities of the spheres that give elements the masses they stand for, kg/m³."""
    sphere = 4 / 3 * np.pi * specimen.radius**3
    if "mechanics/mass" in specimen.columns:
        return specimen.column("mechanics/mass") / sphere
    if specimen.bodies > 1:
        raise PreparedError(f"{specimen.path}: {specimen.bodies} bodies, whose densities are those "
                            "of one; prepare them from a scene in which they move")
    if specimen.volume <= 0:
        raise PreparedError(f"{specimen.path}: no volume of the body in /domain")
    return np.full(len(sphere), _density(explained) * specimen.volume / sphere.sum())


def write_cells(path: Path, specimen: Specimen) -> None:
    """Volumes and faces of the cells, for law voronoi."""
    volume = specimen.column("conduction/volume")
    area, distance = specimen.column("conduction/area"), specimen.column("conduction/distance")
    with open(path, "w") as file:
        file.write(f"volumes {len(volume)}\n")
        for n, v in enumerate(volume):
            file.write(f"{n + 1} {full(v)}\n")
        file.write(f"\nfaces {len(area)}\n")
        for (i, j), a, d in zip(specimen.conductors + 1, area, distance):
            file.write(f"{i} {j} {full(a)} {full(d)}\n")


def write_walls(path: Path, specimen: Specimen) -> None:
    """Conductances to the outside, one section for each exchange."""
    with open(path, "w") as file:
        for name, exchange in specimen.exchanges.items():
            file.write(f"{section(name)} {len(exchange.elements)}\n")
            for i, g in zip(exchange.elements, exchange.values):
                file.write(f"{i + 1} {full(g)}\n")


def section(name: str) -> str:
    """What a section of an exchange is called: one word."""
    return name.replace(" ", "_")


def group_lines(name: str, elements: Any) -> str:
    """A group of elements, a thousand numbers a command at most."""
    ids = [str(i + 1) for i in elements]
    return "".join(f"group {name} id {' '.join(ids[k:k + 1000])}\n"
                   for k in range(0, len(ids), 1000))


def bond_words(beams: Beams, plasticity: Plasticity | None = None, rupture: Rupture | None = None,
               contact: Contact | None = None, damping: float = 0.0) -> str:
    """What bond_coeff says of beams, after the types."""
    young = beams.young_modulus
    words = [full(young), full(beams.shear_modulus)]
    words += (["pair", full(beams.radius_ratio)] if beams.radius_from == "pair"
              else ["radius", full(beams.radius_ratio * beams.mean_radius)])
    if beams.law != "euler-bernoulli":
        words += ["law", beams.law]
        words += [full(beams.shear_coefficient)] if beams.law == "timoshenko" else []
    if plasticity:
        words += ["plasticity", plasticity.law]
        if plasticity.hardening == "linear":
            words += [full(plasticity.yield_strain * young),
                      full(plasticity.hardening_ratio * young)]
        else:
            words += [plasticity.hardening, *_law_words(plasticity.parameters)]
        words += ["yield_section", plasticity.section] if plasticity.section != "middle" else []
        words += ["rate_time", full(plasticity.rate_time)] if plasticity.rate_time else []
    if rupture and rupture.law != "strain-limit":
        words += ["rupture", rupture.law, *_law_words(rupture.parameters)]
    if rupture and np.isfinite(rupture.elastic_strain):
        words += ["rupture_stress", full(rupture.elastic_strain * young)]
    if rupture and np.isfinite(rupture.strain):
        words += ["rupture_strain", full(rupture.strain)]
    if rupture and rupture.section != "middle":
        words += ["rupture_section", rupture.section]
    if contact:
        words += ["contact", full(contact.stiffness_ratio)]
        if contact.rebonding_pressure:
            words += ["rebonding_pressure", full(contact.rebonding_pressure)]
    words += ["damping", full(damping)] if damping else []
    return " ".join(words)


def warmth_words(parameters: Parameters) -> str:
    """What bond_coeff says of heat, after all else; begins with a blank if there is any."""
    words: list[str] = []
    if parameters.expansion:
        words += ["expansion", *_over_temperature_words(parameters.expansion.coefficient),
                  "from", full(parameters.expansion.reference_temperature)]
    if parameters.softening:
        words += ["softening", *_over_temperature_words(parameters.softening)]
    if parameters.plastic_heat:
        words += ["plastic_heat", full(parameters.plastic_heat)]
    return "".join(f" {word}" for word in words)


def _over_temperature_words(known: OverTemperature) -> list[str]:
    """A number, or the points of a table."""
    if len(known.value) == 1:
        return [full(known.value[0])]
    if len(known.value) > MOST_POINTS:
        raise PreparedError(f"a property over temperature has {len(known.value)} points; LIGGGHTS "
                            f"takes {MOST_POINTS} at most")
    points = zip(known.temperature, known.value)
    return ["table", str(len(known.value)), *(full(x) for point in points for x in point)]


def _law_words(parameters: dict[str, float]) -> list[str]:
    """The parameters of a law of bonds, each after its name."""
    return [word for name, value in parameters.items() for word in (name, full(value))]


def beam_lines(specimen: Specimen, parameters: Parameters, directory: Path = Path()) -> str:
    """The commands for bonds, contacts, tools, grips and motion; meshes of tools go to the directory.

    Groups and fixes of the grips are called grip0 ... in the order of the scene, all other elements
    are the group free.
    """
    parameters.require_support()
    if parameters.beams is None:
        raise PreparedError(f"{specimen.path}: the scene has no [beams]")
    parameters.beams.rigidity(specimen)
    of_broken_bonds = parameters.contact if parameters.rupture else None
    words = bond_words(parameters.beams, parameters.plasticity, parameters.rupture,
                       of_broken_bonds, parameters.bond_damping) + warmth_words(parameters)
    minimal = parameters.rupture.minimal_bonds if parameters.rupture else 0
    lines = f"bond_style solidem/beam\nbond_coeff 1 {words}\nfix bonds all solidem/bonds"
    lines += f" minimal_bonds {minimal}\n" if minimal else "\n"
    lines += contact_lines(specimen, parameters, directory) + field_lines(parameters)
    for number, grip in enumerate(parameters.grips):
        lines += _grip_lines(f"grip{number}", grip, specimen.sets[f"grip.{grip.name}"])
        if parameters.bond_damping:  # which sees velocities from the start
            lines += f"velocity grip{number} set {_speed(grip)} units box\n"
    held = " ".join(f"grip{number}" for number in range(len(parameters.grips)))
    lines += f"group free subtract all {held}\n" if held else ""
    return lines + f"fix motion {'free' if held else 'all'} nve/solidem\n"


def contact_lines(specimen: Specimen, parameters: Parameters, directory: Path) -> str:
    """The commands for contacts and tools in LIGGGHTS' own words, if the scene has such."""
    require_same_law(specimen, parameters)
    if not has_contacts(parameters):
        return ""
    types = types_of(specimen, parameters)
    # Bins do not work in a box that is small beside them, meshes not without.
    search = "bin" if len(specimen.radius) > 100 or has_meshes(parameters) else "nsq"
    return (f"neighbor {full(SKIN * float(specimen.radius.mean()))} {search}\n"
            "neigh_modify delay 0 every 1 check yes once no\n"
            + pair_lines(types, parameters) + tool_lines(specimen, parameters, types, directory))


def loose_lines(specimen: Specimen, parameters: Parameters, directory: Path = Path()) -> str:
    """The commands for loose elements and tools; meshes go to the directory."""
    parameters.require_support()
    if parameters.grips:
        raise PreparedError("[[grips]] among loose elements are not understood")
    return (contact_lines(specimen, parameters, directory) + field_lines(parameters)
            + "fix motion all nve/sphere\n")


def field_lines(parameters: Parameters) -> str:
    """The commands for gravity; PreparedError for local damping, which LIGGGHTS has not."""
    if parameters.local_damping:
        raise PreparedError("[damping] local is not supported in LIGGGHTS")
    strength = float(np.linalg.norm(parameters.gravity))
    if strength == 0:
        return ""
    towards = " ".join(full(g / strength) for g in parameters.gravity)
    return f"fix gravity all gravity {full(strength)} vector {towards}\n"


def _speed(grip: Grip) -> str:
    """The words for a grip's velocity."""
    return " ".join("NULL" if v is None else full(v) for v in grip.velocity)


def _grip_lines(name: str, grip: Grip, elements: Integers) -> str:
    """Elements held or moved steadily; along free axes, and in turning, they obey their bonds."""
    lines = group_lines(name, elements)
    lines += f"fix {name} {name} move linear {_speed(grip)} units box\n"
    return lines if grip.rotation_fixed else (
        lines + f"fix {name}_turning {name} nve/solidem rotation_only\n")


def pair_words(forces: CentralForces) -> str:
    """What pair_style says of central forces, after the style's name."""
    words = [forces.law]
    for name, value in forces.parameters.items():
        words += [name, full(value)]
    words += ["range", full(forces.range)]
    if forces.bond_tolerance is not None:
        words += ["tolerance", full(forces.bond_tolerance)]
    words += ["equilibrium", forces.equilibrium, "neighbours", forces.neighbours,
              "interpenetration", full(forces.interpenetration)]
    if forces.dissipation:
        words += ["dissipation", full(forces.dissipation)]
    return " ".join(words)


def damage_words(damage: Damage) -> str:
    """What fix solidem/damage says, after the style's name."""
    words: list[str] = []
    if damage.crack_threshold is not None:
        words = ["crack_threshold", full(damage.crack_threshold), "every", str(damage.every)]
    if damage.minimal_neighbours:
        words += ["minimal_neighbours", str(damage.minimal_neighbours),
                  "removal_every", str(damage.removal_every)]
    return " ".join(words)


def central_lines(specimen: Specimen, parameters: Parameters) -> str:
    """The commands for central forces, damage and motion. Groups and fixes of the grips are called
    grip0 ... in the order of the scene, all other elements are the group free, the damage is the fix
    damage."""
    parameters.require_support()
    forces, damage = parameters.central_forces, parameters.damage
    if forces is None:
        raise PreparedError(f"{specimen.path}: the scene has no [central_forces]")
    # Bins do not work in a box that is small beside them.
    search = "bin" if len(specimen.radius) > 100 else "nsq"
    skin = max(forces.skin, LEAST_SKIN) * float(specimen.radius.mean())
    lines = f"neighbor {full(skin)} {search}\n"
    lines += "neigh_modify delay 0 every 1 check yes once no\n"
    lines += f"pair_style solidem/central {pair_words(forces)}\npair_coeff * *\n"
    if damage and damage_words(damage):
        lines += f"fix damage all solidem/damage {damage_words(damage)}\n"
    lines += field_lines(parameters)
    for number, grip in enumerate(parameters.grips):
        name, speed = f"grip{number}", _speed(grip)
        lines += group_lines(name, specimen.sets[f"grip.{grip.name}"])
        lines += f"velocity {name} set {speed} units box\n"  # dissipation sees it from the start
        lines += f"fix {name} {name} move linear {speed} units box\n"
    held = " ".join(f"grip{number}" for number in range(len(parameters.grips)))
    lines += f"group free subtract all {held}\n" if held else ""
    return lines + f"fix motion {'free' if held else 'all'} nve\n"


def _density(explained: dict[str, Any]) -> float:
    if not isinstance(explained.get("density"), (int, float)):
        raise PreparedError(f"density is {explained.get('density')}; only one number for the whole "
                            "body is understood")
    return float(explained["density"])


def _require_one_capacity(specimen: Specimen, capacity: float) -> None:
    """PreparedError when some element stores other than this, J/(m³ K)."""
    expected = capacity * specimen.column("conduction/volume")
    off = float(np.abs(specimen.column("conduction/heat_capacity") / expected - 1).max())
    if off > 1e-9:
        raise PreparedError(f"{specimen.path}: /conduction/heat_capacity differs by {off:g} from "
                            f"that of {capacity:g} J/(m^3 K) everywhere; only one material is "
                            "understood")


def heat_lines(specimen: Specimen, parameters: Parameters, explained: dict[str, Any],
               directory: Path) -> str:
    """The commands for conduction and what heats the body; their files go to the directory.

    The fixes are called heat, friction, touch, temperature0 ..., exchange0 ... in the order of the scene.
    """
    parameters.require_support()
    law = parameters.conduction
    if law is None:
        raise PreparedError(f"{specimen.path}: the scene has no [conduction]")
    if parameters.rupture:
        raise PreparedError(f"{specimen.path}: the scene has [rupture] and [conduction]; in LIGGGHTS "
                            "bonds that break cannot conduct heat as well, whatever broken_bonds")
    law.require_one_material(specimen)
    _require_one_capacity(specimen, _density(explained) * law.specific_heat_capacity)
    words = f"law {law.law}"
    if law.law == "platonic-calibrated":
        words += f" area_factor {full(law.area_factor)} volume {full(specimen.volume)}"
    elif law.law == "voronoi":
        words += " file cells.txt"
        write_cells(directory / "cells.txt", specimen)
    lines = (f"fix heat all solidem/conduction {words} conductivity {full(law.conductivity)} "
             f"specific_heat {full(law.specific_heat_capacity)} density {full(_density(explained))} "
             f"initial_temperature {full(law.initial_temperature)}"
             + (f" every {law.every}\n" if law.every > 1 else "\n"))
    lines += friction_lines(parameters) + touch_lines(parameters)
    for number, (name, value) in enumerate(parameters.temperatures.items()):
        lines += group_lines(f"temperature{number}", specimen.sets[f"temperature.{name}"])
        lines += f"fix temperature{number} temperature{number} solidem/temperature {full(value)}\n"
    if parameters.exchanges:
        write_walls(directory / "walls.txt", specimen)
    for number, (name, value) in enumerate(parameters.exchanges.items()):
        if name not in specimen.exchanges:
            raise PreparedError(f"{specimen.path}: /conduction/exchanges/{name} is missing")
        lines += (f"fix exchange{number} all solidem/exchange file walls.txt name {section(name)} "
                  f"temperature {full(value)}\n")
    if parameters.powers:
        _write_sources(directory / "sources.txt", specimen, parameters)
        lines += ("run 0\nvariable sources atomfile sources.txt\n"
                  "set group all property/atom heatSource v_sources\n")
    return lines


def _write_sources(path: Path, specimen: Specimen, parameters: Parameters) -> None:
    """Constant power into each element, for a variable of style atomfile; zero if not listed."""
    power = np.zeros(len(specimen.radius))
    for name in parameters.powers:
        if name not in specimen.powers:
            raise PreparedError(f"{specimen.path}: /conduction/powers/{name} is missing")
        np.add.at(power, specimen.powers[name].elements, specimen.powers[name].values)
    heated = np.flatnonzero(power)
    path.write_text("".join([f"{len(heated)}\n", *(f"{i + 1} {full(power[i])}\n" for i in heated)]))


def whole_script(specimen: Specimen, parameters: Parameters, parts: list[str]) -> str:
    """A script that reads body.data and these parts, and runs what the scene runs."""
    boundary = " ".join("p" if p else "m" for p in specimen.periodic)
    styles = "bond_style      none\n" if parameters.beams is None else ""
    if not parameters.central_forces:
        skin = full(0.5 * float(specimen.radius.mean()))
        styles = f"pair_style      none\nneighbor        {skin} bin\n" + styles
    every = max(1, parameters.steps // 10)
    return (HEAD.format(boundary=boundary, styles=styles, time_step=full(parameters.time_step))
            + "".join(f"include         {part}\n" for part in parts)
            + FOOT.format(every=every, columns=" %.17g" * 9, steps=parameters.steps))


def _tell_differences(specimen: Specimen, parameters: Parameters, nearly: bool) -> None:
    """PreparedError where contacts are not quite the scene's, or a note where that is wanted."""
    parameters.require_support()
    require_same_law(specimen, parameters)
    found = differences(specimen, parameters)
    if found and not nearly:
        raise PreparedError("LIGGGHTS does not do quite the same. " + ". ".join(found)
                            + ". With --nearly it is written all the same")
    for one in found:
        print(f"export.py: note: {one}", file=sys.stderr)


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("specimen", type=Path, help="output of solidem prepare, HDF5")
    parser.add_argument("parameters", type=Path, help="output of solidem explain --json")
    parser.add_argument("directory", type=Path, help="where the files go")
    parser.add_argument("--nearly", action="store_true",
                        help="also where contacts are those of LIGGGHTS only nearly; says where")
    arguments = parser.parse_args()
    arguments.directory.mkdir(parents=True, exist_ok=True)
    try:
        specimen = read_specimen(arguments.specimen)
        explained = json.loads(arguments.parameters.read_text())
        parameters = parse_parameters(explained)
        _tell_differences(specimen, parameters, arguments.nearly)
        lines = {}
        if parameters.beams:
            lines["beams.in"] = beam_lines(specimen, parameters, arguments.directory)
        if parameters.central_forces:
            lines["central.in"] = central_lines(specimen, parameters)
        if parameters.is_loose:
            lines["grains.in"] = loose_lines(specimen, parameters, arguments.directory)
        if parameters.conduction or not lines:
            lines["heat.in"] = heat_lines(specimen, parameters, explained, arguments.directory)
        types = types_of(specimen, parameters) if has_contacts(parameters) else None
        write_data(arguments.directory / "body.data", specimen, bonds_of(specimen, parameters),
                   sphere_density(specimen, explained), types, tool_places(specimen, parameters))
        lines["run.in"] = whole_script(specimen, parameters, list(lines))
        for name, text in lines.items():
            (arguments.directory / name).write_text(text)
    except (PreparedError, OSError, ValueError) as error:
        sys.exit(f"export.py: {error}")


if __name__ == "__main__":
    main()
