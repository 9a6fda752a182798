# SPDX-License-Identifier: GPL-2.0-or-later
"""What a scene leaves open besides its fineness: law of conduction, integrator, time step, steps of
heat. Each is tried on a coarse body of one packing, so that packings do not hide what it is worth."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, Mapping

from ._core import InputError, RunError
from .pilots import Pilot, Pilots

BUDGET = 0.1  #: share of the error that each choice may take
STEPS = (0.8, 0.4, 0.2, 0.1, 0.05)  #: of the largest stable one
STEPS_OF_CONTACT = (0.4, 0.2, 0.1, 0.05, 0.025)
LAWS = ("voronoi", "platonic-calibrated", "platonic")  #: of conduction, the most exact first
PAYS = 0.95  #: of the time, or less: then a choice that errs is worth making
EVERY = (300, 100, 30, 10, 3)  #: steps of motion from one of heat to the next
GROWTH = 8.0  #: how many times the pilot's elements the integrator of heat is chosen for
TEARS = {"rupture", "damage"}  #: sections of scenes whose elements may part
HEAT_STEPS = ("run.time_step", "run.time_step_ratio")


@dataclass(frozen=True)
class Worth:
    """What a choice is worth, on one body."""

    choice: str  #: what of
    taken: str
    instead: str  #: of the scene, or of what else was tried
    moves: float  #: the figure, as a share of its scale
    time: float  #: of the steps, over that with the other
    why: str


@dataclass
class Choices:
    """What was chosen up to now."""

    changes: dict[str, Any] = field(default_factory=dict)
    worth: list[Worth] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)
    step_error: float = 0.0  #: share, of the coarse body
    fraction: float = 0.0  #: of the stable step; 0: inner steps are chosen by a tolerance
    law: str = ""  #: of conduction
    time_exponent: float | None = 4 / 3  #: of steps' time over elements; None: to be measured


class Chooser:
    """Tries one choice after another on one body."""

    def __init__(self, pilots: Pilots, tables: Mapping[str, Any], kind: str, error: float,
                 factor: float) -> None:
        self.pilots, self.tables, self.kind, self.error = pilots, tables, kind, error
        self.factor = factor
        self.found = Choices()

    def _try(self, **changes: Any) -> Pilot | None:
        """A run with what was chosen and these; None: the scene does not allow it, or breaks off."""
        try:
            return self.pilots.run(self.factor, {**self.found.changes, **changes})
        except (InputError, RunError):
            return None

    def _moves(self, one: Pilot, other: Pilot) -> float:
        return abs(one.figure - other.figure) / max(one.scale, other.scale, 1e-300)

    def _note(self, choice: str, taken: str, instead: str, new: Pilot, old: Pilot, why: str) -> None:
        self.found.worth.append(Worth(choice, taken, instead, self._moves(new, old),
                                      new.cost.steps / max(old.cost.steps, 1e-9), why))

    def all(self) -> Choices:
        """Law, then what heats and moves in time."""
        own = self.pilots.run(self.factor, {})
        run = self.tables["run"]
        if "steps" in run:
            # Finer bodies take shorter steps: what shall stay is how long the run lasts.
            self.found.changes |= {"run.steps": None, "run.duration": f"{own.duration!r} s"}
            self.found.notes.append(f"[run] steps = {run['steps']} is read as a duration of "
                                    f"{own.duration:g} s, so that finer bodies do the same")
        if "conduction" in self.tables:
            own = self._law(own)
            own = self._walls(own)
        own = self._readings(own)
        if self.kind == "heat":
            self._heat(own)
        else:
            if self.kind == "coupled":
                own = self._every(own)
            self._step(own)
        return self.found

    def _law(self, own: Pilot) -> Pilot:
        """The most exact that the scene allows."""
        before = self.tables["conduction"].get("law", "platonic")
        for law in LAWS:
            if law == before:
                self.found.law = law
                break
            if (other := self._try(**{"conduction.law": law})) is not None:
                self._note("law of conduction", law, before, other, own,
                           "the studies: the other errs however fine the body is")
                self.found.changes["conduction.law"] = law
                self.found.law, own = law, other
                break
        if self.found.law != "voronoi":
            self.found.notes.append(
                f"the law of conduction stays {self.found.law}: this scene does not take voronoi, "
                "and what the law itself errs by is no error of fineness")
        return own

    def _walls(self, own: Pilot) -> Pilot:
        """Walls that are held in place of layers: what finer bodies tend to is the same, and they need not
        be as fine for it."""
        if self.found.law != "voronoi":
            return own
        for table in self.tables.get("temperatures", []):
            region, name = table.get("region", {}), table.get("name")
            if name is None or set(region) != {"axis", "side", "layers"}:
                continue
            wall = f"{region['axis']}_{region['side']}"
            changes = {f"temperatures.{name}.region": None, f"temperatures.{name}.wall": wall}
            own = self._adopt(own, changes, f"temperature {name}", f"wall {wall}",
                              f"{region['layers']} layers of elements", "layers are as thick as elements")
        return own

    def _readings(self, own: Pilot) -> Pilot:
        """The sensor that is asked for reads between elements, for the nearest is somewhere else in each
        packing: temperatures where cells tell them, motion of what beams hold together."""
        holds = "beams" in self.tables and not TEARS & set(self.tables)
        for table in self.tables.get("sensors", []):
            allowed = self.found.law == "voronoi" if table.get("quantity") == "temperature" else holds
            asked = self.pilots.of.startswith(f"sensor.{table.get('name')}.")
            if not (asked and allowed) or table.get("sampling") == "fit":
                continue
            own = self._adopt(own, {f"sensors.{table['name']}.sampling": "fit"}, f"sensor {table['name']}",
                              "fit", "nearest element", "the nearest element is up to a radius away")
        return own

    def _adopt(self, own: Pilot, changes: dict[str, Any], choice: str, taken: str, instead: str,
               why: str) -> Pilot:
        """These changes, where the scene allows them."""
        other = self._try(**changes)
        if other is None:
            return own
        self._note(choice, taken, instead, other, own, why)
        self.found.changes |= changes
        return other

    def _heat(self, own: Pilot) -> None:
        """Explicit steps, or a tolerance: what takes less time for a body some times finer."""
        stepped = {key: None for key in HEAT_STEPS}
        explicit = {**stepped, "conduction.integrator": "explicit", "conduction.tolerance": None}
        changes = self._present(explicit) | {"run.time_step_ratio": 0.5}
        slow = self._try(**changes)
        fraction = 0.9 * slow.limit_ratio if slow else 0.0
        changes = {**changes, "run.time_step_ratio": round(fraction, 3)}
        fast = self._try(**changes) if slow else None
        auto, auto_changes, auto_error = self._tolerance(own, stepped)
        if fast is not None and slow is not None:
            error = self._moves(fast, slow) * fraction / max(fraction - 0.5, 0.1)
            later = fast.cost.steps * GROWTH**(5 / 3)
            if error <= BUDGET * self.error and (
                    auto is None or later < auto.cost.steps * GROWTH**(4 / 3)):
                self._note("integrator", "explicit, 0.9 of the stable step",
                           "a tolerance" if auto else "shorter steps", fast, auto or slow,
                           "takes less time, for finer bodies too")
                self.found.changes |= changes
                self.found.step_error, self.found.fraction = error, 0.9
                self.found.time_exponent = 5 / 3
                return
        if auto is None:
            raise InputError(f"{self.pilots.scene.path}: neither explicit steps nor a tolerance "
                             f"keep {100 * BUDGET * self.error:.2g} % on the coarsest body; expected "
                             "a larger --error")
        if fast is not None:
            self._note("integrator", f"auto, tolerance {auto_changes['conduction.tolerance']}",
                       "explicit", auto, fast, "explicit steps shorten as the square of the size")
        self.found.changes |= auto_changes
        self.found.step_error, self.found.time_exponent = auto_error, None

    def _tolerance(self, own: Pilot, stepped: dict[str, Any]
                   ) -> tuple[Pilot | None, dict[str, Any], float]:
        """The integrator auto, with a tolerance that a tenth of does not move the figure."""
        kelvin = float(f"{self.error * (own.warmest or 100) / 2:.1g}")
        base = self._present(stepped) | {"conduction.integrator": "auto"}
        before = self._try(**base, **{"conduction.tolerance": f"{kelvin:g} K"})
        while before is not None and kelvin > 1e-6 * (own.warmest or 100):
            finer = self._try(**base, **{"conduction.tolerance": f"{kelvin / 10:.3g} K"})
            if finer is None:
                break
            moved = self._moves(before, finer)
            if moved <= BUDGET * self.error:
                return before, {**base, "conduction.tolerance": f"{kelvin:g} K"}, moved
            before, kelvin = finer, kelvin / 10
        return None, {}, 0.0

    def _present(self, gone: Mapping[str, Any]) -> dict[str, Any]:
        """Keys that go are named only where they are."""
        return {key: value for key, value in gone.items()
                if value is not None or key.split(".")[1] in self.tables.get(key.split(".")[0], {})}

    def _every(self, own: Pilot) -> Pilot:
        """The steps of heat that take least time of those that do not move the figure."""
        table = self.tables["conduction"]
        if "largest_change" in table:
            self.found.notes.append("[conduction] largest_change: heat chooses its steps already")
            return own
        each = self._try(**{"conduction.every": 1}) if table.get("every", 1) != 1 else own
        if each is None:
            return own
        found = [(run, every) for every in EVERY
                 if (run := self._try(**{"conduction.every": every})) is not None
                 and every * 20 <= run.steps
                 and self._moves(run, each) <= BUDGET * self.error]
        best, every = min(found, key=lambda pair: pair[0].cost.steps, default=(each, 1))
        if best.cost.steps < PAYS * each.cost.steps:
            self._note("steps of heat", f"one in {every} of the motion", "one in each", best, each,
                       "heat is slow beside sound")
            self.found.changes["conduction.every"] = every
            self.found.step_error += self._moves(best, each)
            return best
        return each

    def _step(self, own: Pilot) -> None:
        """The longest step of motion that does not move the figure."""
        limit = own.limit_ratio
        if not limit:
            self.found.notes.append("this scene has no stable step to choose a share of: its own stays")
            return
        stepped = self._present({"run.time_step": None})
        tried: list[tuple[float, dict[str, Any], Pilot]] = []
        for fraction in (STEPS_OF_CONTACT if self._touches() else STEPS):
            changes = {**stepped, "run.time_step_ratio": round(fraction * limit, 4)}
            run = self._try(**changes)
            if run is None:
                tried.clear()
                continue
            tried.append((fraction, changes, run))
            if len(tried) < 2:
                continue
            (long_fraction, long_changes, long), (_, _, short) = tried[-2:]
            moved = self._moves(long, short) * 4 / 3  # of the second order
            last = self._moves(tried[-3][2], long) * 4 / 3 if len(tried) > 2 else 2 * moved
            if moved <= BUDGET * self.error or moved > 0.7 * last:
                if moved <= BUDGET * self.error or not self.pilots.refinement.bodies:
                    self.found.step_error += moved
                else:
                    self.found.notes.append(
                        f"shorter steps go on moving the figure by {100 * moved:.2g} %: as another "
                        "packing does, so it counts as scatter")
                break
        else:
            if len(tried) < 2:
                raise RunError(f"{self.pilots.scene.path}: no step of "
                               f"{', '.join(f'{step:g}' for step in STEPS)} of the stable one ends "
                               "its run on a coarse body")
            long_fraction, long_changes, long = tried[-1]
            self.found.step_error += moved / 4
        self._note("time step", f"{long_fraction:g} of the stable one", f"{own.ratio / limit:.2g}",
                   long, own, "the longest that keeps the figure")
        self.found.changes |= long_changes
        self.found.fraction = long_fraction

    def _touches(self) -> bool:
        return "contact" in self.tables or "tools" in self.tables
