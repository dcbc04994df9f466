# SPDX-License-Identifier: Apache-2.0
"""The second study: complete laws that have to be found from nothing, and the energy on a path that was never shown."""
import pathlib
import typing
import zlib

import numpy as np
import scipy.special

from . import case_files, laws, verdict
from .bases import Form, Free, between_log
from .deformation import Part, invariant_of, is_isotropic
from .laws import Array
from .figures import share
from .fitting import refit
from .protocol import Curve, channel_slices, observe

NOISES = (0.01, 0.03)  # shares of the largest stress of a curve
DRAWS, REDUCED_DRAWS = 50, 1
GOOD = 0.03  # relative error of the energy that counts as right
NODES, WEIGHTS = scipy.special.roots_legendre(24)


def _neo_hooke(random: np.random.Generator) -> typing.List[Part]:
    return [Part("I1", "linear", {"mu": 1.0})]


def _isihara(random: np.random.Generator) -> typing.List[Part]:
    """0.5 (I1 − 3) + (I2 − 3) + (I1 − 3)², as in EUCLID (Flaschel, Kumar, De Lorenzis 2021)."""
    return [Part("I1", "linear", {"mu": 1.0}), Part("I1", "quadratic", {"k": 2.0}), Part("I2", "linear", {"mu": 2.0})]


def _gent_thomas(random: np.random.Generator) -> typing.List[Part]:
    """0.5 (I1 − 3) + ln(I2/3)."""
    return [Part("I1", "linear", {"mu": 1.0}), Part("I2", "logarithm", {"mu": 2 / 3})]


def _haines_wilson(random: np.random.Generator) -> typing.List[Part]:
    """0.5 (I1 − 3) + (I2 − 3) + 0.7 (I1 − 3)(I2 − 3) + 0.2 (I1 − 3)³: tunica tries its product by name only."""
    return [Part("I1", "linear", {"mu": 1.0}), Part("I2", "linear", {"mu": 2.0}), Part("product", "", {"k": 0.7}),
            Part("I1", "cubic", {"k": 0.6})]


def _arruda_boyce(random: np.random.Generator) -> typing.List[Part]:
    return [Part("I1", "inverse_langevin", {"mu": 1.0, "N": random.uniform(3.5, 6)})]


def _ogden_1(random: np.random.Generator) -> typing.List[Part]:
    return [Part("stretches", "", {"mu": 1.0, "alpha": random.uniform(1.1, 1.6) if random.random() < 0.5 else
                                   random.uniform(2.8, 5)})]


def _ogden_2(random: np.random.Generator) -> typing.List[Part]:
    return [Part("stretches", "", {"mu": 1.0, "alpha": random.uniform(1.2, 1.7)}),
            Part("stretches", "", {"mu": -random.uniform(0.1, 0.3), "alpha": random.uniform(-2.6, -1.8)})]


def _holzapfel(random: np.random.Generator) -> typing.List[Part]:
    return [Part("I1", "linear", {"mu": 1.0}),
            Part("diagonal", "exponential_square", {"k1": random.uniform(0.5, 2), "k2": random.uniform(0.5, 2),
                                                    "theta": random.uniform(25, 65)})]


def _two_families(random: np.random.Generator) -> typing.List[Part]:
    return [Part("I1", "linear", {"mu": 1.0}),
            *(Part(family, "exponential_square", {"k1": random.uniform(0.5, 2), "k2": random.uniform(0.5, 2)})
              for family in ("axial", "circumferential"))]


LAWS: typing.Dict[str, typing.Callable[[np.random.Generator], typing.List[Part]]] = {
    "neo-Hooke": _neo_hooke, "Isihara": _isihara, "Gent–Thomas": _gent_thomas, "Haines–Wilson": _haines_wilson,
    "Arruda–Boyce": _arruda_boyce, "Ogden, 1 term": _ogden_1, "Ogden, 2 terms": _ogden_2, "Holzapfel": _holzapfel,
    "axial and circumferential": _two_families}


def curves(name: str, material: typing.Sequence[Part], random: np.random.Generator) -> typing.List[Curve]:
    """Uniaxial, equibiaxial and shear curves of 20 rows; of fibres both strips, sheets 1:1, 1:0.75, 0.75:1, and shear."""
    def path(most: float, start: float = 1.0) -> Array:
        return np.round(np.linspace(start, most, 20), 4)

    if is_isotropic(material):
        far = 2.6 if name in ("Arruda–Boyce", "Ogden, 1 term", "Ogden, 2 terms") else 1.7
        most = 1 + (far - 1) * random.uniform(0.9, 1.1)
        return [Curve("uniaxial", "uniaxial_nominal", path(most)), Curve("equibiaxial", "equibiaxial", path(most**0.75)),
                Curve("simple_shear", "simple_shear", path(0.8 * most, 0.0))]
    strain = round(random.uniform(0.25, 0.35), 3)
    sheets = [Curve(f"sheet_{k}", "sheet", np.round(np.linspace(0, 1, 20), 4), most=(around * strain, along * strain))
              for k, (around, along) in enumerate(((1, 1), (1, 0.75), (0.75, 1)), 1)]
    return [Curve("circumferential_strip", "uniaxial", path(1 + 1.3 * strain), 1),
            Curve("axial_strip", "uniaxial", path(1 + 1.3 * strain), 2), *sheets,
            Curve("simple_shear", "simple_shear", path(1.3 * strain, 0.0))]


def unseen(protocol: typing.Sequence[Curve]) -> typing.Tuple[Array, Array]:
    """λ1 and λ2 of the path that nothing shows: pure shear of rubber, ratios 1:0.5 and 0.5:1 of tissue."""
    share_of = np.linspace(0.1, 1, 15)
    sheet = next((curve for curve in protocol if curve.kind == "sheet"), None)
    if sheet is None:
        most = next(curve for curve in protocol if curve.kind == "equibiaxial").load[-1]
        return 1 + share_of * (most - 1), np.ones_like(share_of)
    long, short = 1 + share_of * sheet.most[0], 1 + 0.5 * share_of * sheet.most[0]
    return np.concatenate([long, short]), np.concatenate([short, long])


def energy(parts: typing.Sequence[Part], l1: Array, l2: Array,
           slopes: typing.Optional[typing.Sequence[typing.Callable[[Array], Array]]] = None) -> Array:
    """W (kPa) of a sheet, n numbers: every ψ' integrated from rest. `slopes` stand in for the laws of the parts."""
    total = np.zeros_like(l1)
    for k, part in enumerate(parts):
        if part.invariant == "stretches":
            mu, alpha = part.values["mu"], part.values["alpha"]
            logs = [np.log(l1), np.log(l2), -np.log(l1 * l2)]
            total += sum(mu * np.expm1(alpha * one) / alpha if alpha else mu * one for one in logs)
            continue
        if part.invariant == "product":
            x, y = (invariant_of(Part(one, "", {}), l1, l2)[0] for one in ("I1", "I2"))
            total += part.values["k"] * x * y
            continue
        x = np.maximum(invariant_of(part, l1, l2)[0], 0.0)
        at = 0.5 * x[:, None] * (1 + NODES)
        values = slopes[k](at) if slopes is not None else laws.slope(part.law, at, part.values)
        total += (2 if part.invariant == "diagonal" else 1) * 0.5 * x * (values @ WEIGHTS)
    return total


def all_free(parts: typing.Sequence[Part]) -> Form:
    """The law with all its parameters unknown, each within a factor of 50, angles and exponents within their ranges."""
    free = []
    for k, part in enumerate(parts):
        for name, value in part.values.items():
            if name == "theta":
                free.append(Free(k, name, 1.0, 89.0, False))
            elif name == "alpha":
                free.append(Free(k, name, value - 0.9 * abs(value), value + 3 * abs(value), False))
            elif name == "N":
                free.append(Free(k, name, 0.9 * value, 50 * value, True))
            elif value < 0:
                free.append(Free(k, name, 50 * value, value / 50, False))
            else:
                free.append(Free(k, name, value / 50, 50 * value, True))
    return Form(tuple(parts), tuple(free))


def relative_error(found: Array, true: Array) -> float:
    """Root mean square of a difference of energies over that of the true one; infinite where it is not a number."""
    error = float(np.sqrt(np.mean((found - true)**2) / np.mean(true**2)))
    return error if np.isfinite(error) else float("inf")


def make(name: str, noise: float, index: int, seed: int, out: pathlib.Path) -> str:
    """Writes a case below out/cases and out/truths; its name. Moduli are 20 to 400 kPa, coefficients drawn within 20 %."""
    random = np.random.default_rng([seed, zlib.crc32(name.encode()), round(1000 * noise), index])
    folder = f"{int(random.integers(1 << 40)):010x}"
    if (out / "cases" / folder / case_files.SEAL).exists():
        return folder
    drawn, scale = LAWS[name](random), between_log(random, 20, 400)
    amplitudes = ("mu", "k", "k1")
    parts = [part._replace(values={key: value * (scale * float(np.exp(0.2 * random.standard_normal()))
                                                 if key in amplitudes else 1) for key, value in part.values.items()})
             for part in drawn]
    protocol = curves(name, parts, random)
    clean = observe(protocol, parts)
    sds: typing.List[float] = []
    slices = channel_slices(protocol)
    for curve in protocol:
        own = slices[len(sds):len(sds) + curve.channels]
        largest = max(float(np.max(np.abs(clean[rows]))) for rows in own)
        sds += [case_files.significant(noise * largest)] * curve.channels
    stated = case_files.Noise(sds, [0.0] * len(sds))
    noisy = clean + stated.sd(protocol, clean) * random.standard_normal(len(clean))
    l1, l2 = unseen(protocol)
    sd, true = stated.sd(protocol, clean), energy(parts, l1, l2)
    oracle = relative_error(energy(refit(all_free(parts), protocol, noisy, sd).material, l1, l2), true)
    truth = {"law": name, "noise": noise, "index": index, "seed": seed, "oracle_error": oracle,
             "terms": [{"invariant": part.invariant, "law": part.law, "parameters": part.values} for part in parts],
             "path": {"circumferential": [float(v) for v in l1], "axial": [float(v) for v in l2],
                      "energy": [float(v) for v in true]}}
    model = "neo_hooke" if is_isotropic(parts) else "hgo"
    case_files.write_case(out / "cases", out / "truths", folder, model, protocol, noisy, stated, truth, from_nothing=True)
    return folder


class Judged(typing.NamedTuple):
    """exact: the same terms, laws included; invariants: the same set of invariants; error: of the energy, relative rms;
    oracle: the same of a fit that knows the law."""
    law: str
    noise: float
    exact: bool
    invariants: bool
    error: float
    oracle: float


def found_energy(terms: typing.Sequence[verdict.Found], l1: Array, l2: Array) -> Array:
    """W along a path of the terms that were found; not a number where a term is none that this module knows."""
    known = ("I1", "I2", "axial", "circumferential", "diagonal", "stretches")
    if not terms or any(term.invariant not in known for term in terms):
        return np.full_like(l1, np.nan)
    parts = [Part(term.invariant, term.law, term.parameters) for term in terms]
    return energy(parts, l1, l2, [term.law_at if term.law in laws.PARAMETERS else term.at for term in terms])


def judge(truth: typing.Dict[str, typing.Any], said: verdict.Verdict) -> Judged:
    hidden = sorted((term["invariant"], term["law"]) for term in truth["terms"])
    found = sorted((term.invariant, "" if term.invariant == "stretches" else term.law) for term in said.terms)
    path = truth["path"]
    true = np.array(path["energy"])
    error = relative_error(found_energy(said.terms, np.array(path["circumferential"]), np.array(path["axial"])), true)
    return Judged(truth["law"], truth["noise"], hidden == found, {one for one, _ in hidden} == {one for one, _ in found},
                  error, truth["oracle_error"])


def table(heading: str, judged: typing.Sequence[Judged]) -> str:
    """A row for each law and noise: shares with Wilson's 95 % intervals."""
    lines = [heading, "", "| hidden law | noise | draws | terms and laws exact | invariants exact | energy on an unseen "
             f"path within {GOOD:.0%} | median error | of the oracle |", "|---|---|---|---|---|---|---|---|"]
    for law in LAWS:
        for noise in NOISES:
            own = [one for one in judged if (one.law, one.noise) == (law, noise)]
            if not own:
                continue
            shares = [share("", (one.exact for one in own)), share("", (one.invariants for one in own)),
                      share("", (one.error <= GOOD for one in own))]
            told = " | ".join(f"{one.value:.2f} ({one.low:.2f}–{one.high:.2f})" for one in shares)
            medians = [float(np.median(errors)) for errors in ([one.error for one in own], [one.oracle for one in own])]
            lines.append(f"| {law} | {noise:.0%} | {len(own)} | {told} | {medians[0]:.1%} | {medians[1]:.1%} |")
    return "\n".join(lines) + "\n"
