# SPDX-License-Identifier: Apache-2.0
"""Cases of the blind benchmark of discovery: what each hides, how large it is, and what an oracle makes of it."""
import pathlib
import typing
import zlib

import numpy as np

from . import laws
from .bases import Form, RUBBERS, curves, draw, with_term
from .case_files import Noise, SEAL, draw_noise, write_case
from .deformation import Part
from .laws import Array
from .fitting import Unreachable, dial, misfit, refit, rivals, slope_error
from .protocol import Curve, RigError, channel_slices, observe, reach

OF_RUBBER, OF_TISSUE = ("I1", "I2"), ("I1", "I2", "axial", "circumferential", "diagonal")
RIG_ERRORS = ("force_offset", "force_scale", "thickness", "reference_length", "stretch_offset", "drift", "gain_drift")
GRID = 41        # x at which slopes are compared
ORACLE_DRAWS = 5  # of noise, beside that of the case
PLAUSIBLE = 2.0  # largest share of the base's readings that a hidden term may add


class Spec(typing.NamedTuple):
    """What a case is to be: `what` is null, single, pair, kinked, unusual or rig; Λ is 0 where nothing is hidden."""
    what: str
    base: str
    target: float
    number: int
    noise: str
    stated: bool


def invariants(base: str) -> typing.Tuple[str, ...]:
    return OF_RUBBER if base in RUBBERS else OF_TISSUE


def level_is_free(base: str, invariant: str) -> bool:
    """Whether the base is linear in the invariant, so that a constant in ψ' is the base's as well as the term's."""
    return invariant == "I1" or (base == "mooney_rivlin" and invariant == "I2")


def draw_term(base: str, form: Form, protocol: typing.Sequence[Curve], random: np.random.Generator, what: str,
              taken: typing.Sequence[str] = ()) -> Part:
    """A term that the base lacks, of an amplitude of 1 kPa. Chains are a function of I1, and the logarithm one of I2; the
    other way round they are unusual."""
    possible_invariants = OF_RUBBER if what == "unusual" else invariants(base)
    invariant = str(random.choice([one for one in possible_invariants if one not in taken]))
    strange = {"I1": "logarithm", "I2": "inverse_langevin"}.get(invariant, "")
    possible: typing.Sequence[str] = [law for law in laws.OF_I1_AND_I2 if law != strange]
    if what == "unusual":
        possible = [strange]
    elif what == "kinked":
        possible = laws.KINKED
    elif invariant not in ("I1", "I2"):
        possible = [law for law in laws.OF_FIBRES if (base, invariant, law) != ("hgo", "diagonal", "exponential_square")]
    elif level_is_free(base, invariant):
        possible = [law for law in possible if law != "linear"]
    law = str(random.choice(list(possible)))
    values = {"theta": round(random.uniform(25, 65), 1)} if invariant == "diagonal" else {}
    part = Part(invariant, law, values)
    return part._replace(values={**laws.draw(law, reach(protocol, form.material, part), random), **values})


def grown(part: Part, amplitude: float) -> Part:
    """The term with its amplitude in kPa."""
    return part._replace(values={**part.values, laws.PARAMETERS[part.law][0]: amplitude})


def draw_rig_error(protocol: typing.Sequence[Curve], y: Array, random: np.random.Generator) -> RigError:
    """With the largest plausible amount: a fifth of the span or of the gain, a tenth of the strain or of the length."""
    kind = str(random.choice(RIG_ERRORS))
    curve = int(random.integers(len(protocol)))
    if kind == "reference_length":
        while protocol[curve].kind == "simple_shear":  # a scale of the shear is one of its displacement, and no length
            curve = int(random.integers(len(protocol)))
    first = sum(one.channels for one in protocol[:curve])
    channel = -1 if kind == "thickness" else int(random.integers(protocol[curve].channels))
    span = float(np.ptp(y[channel_slices(protocol)[first + max(channel, 0)]]))
    load = protocol[curve].load
    strain = max(protocol[curve].most) if protocol[curve].kind == "sheet" else float(np.ptp(load))
    most = {"force_offset": 0.2 * span, "drift": 0.2 * span, "reference_length": 0.1, "stretch_offset": 0.1 * strain}
    return RigError(kind, curve, channel, most.get(kind, 0.2) * float(random.choice([-1, 1])))


def oracle(form: Form, protocol: typing.Sequence[Curve], clean: Array, sd: Array, noisy: Array,
           parts: typing.Sequence[Part], grids: typing.Sequence[Array], free: typing.Sequence[bool],
           random: np.random.Generator) -> typing.Tuple[typing.List[float], float]:
    """Of a fit that knows base and form, starts at the truth and has the true noise: root mean square of its error of ψ'
    (kPa) of each term, over the noise of the case and ORACLE_DRAWS others; and χ² that it leaves in the case."""
    full, known = form, len(form.material)
    for part, grid in zip(parts, grids):
        full = with_term(full, part, float(grid[-1]))
    squares, chi2 = np.zeros(len(parts)), 0.0
    for k in range(1 + ORACLE_DRAWS):
        y = noisy if k == 0 else clean + sd * random.standard_normal(len(clean))
        fit = refit(full, protocol, y, sd)
        chi2 = fit.chi2 if k == 0 else chi2
        for i, (part, grid) in enumerate(zip(parts, grids)):
            found = laws.slope(part.law, grid, fit.material[known + i].values)
            squares[i] += slope_error(found, laws.slope(part.law, grid, part.values), free[i])**2
    return [float(v) for v in np.sqrt(squares / (1 + ORACLE_DRAWS))], chi2


def hide(spec: Spec, random: np.random.Generator) -> typing.Tuple[
        Form, typing.List[Curve], Array, Noise, typing.List[Part], typing.Optional[RigError]]:
    """Base, protocol, readings without noise, noise, hidden terms and rig error. Raises Unreachable."""
    form = draw(spec.base, random)
    protocol = curves(spec.base, form, random)
    bare = observe(protocol, form.material)
    noise = draw_noise(spec.noise, protocol, bare, random)

    def sd(y: Array) -> Array:
        return noise.sd(protocol, y)

    if spec.what == "null":
        return form, protocol, bare, noise, [], None
    if spec.what == "rig":
        error = draw_rig_error(protocol, bare, random)
        share = dial(lambda a: observe(protocol, form.material, error._replace(amount=a * error.amount)), sd, form, protocol,
                     spec.target, 1.0, random)
        error = error._replace(amount=share * error.amount)
        return form, protocol, observe(protocol, form.material, error), noise, [], error
    parts: typing.List[Part] = []
    for _ in range(2 if spec.what == "pair" else 1):
        part = draw_term(spec.base, form, protocol, random, spec.what, [one.invariant for one in parts])
        effect = observe(protocol, [grown(part, 1.0)]) if spec.base in RUBBERS else observe(
            protocol, [*form.material, grown(part, 1.0)]) - bare
        most = PLAUSIBLE * float(np.max(np.abs(bare)) / max(float(np.max(np.abs(effect))), 1e-9))
        amplitude = dial(lambda a: observe(protocol, [*form.material, grown(part, a)]), sd, form, protocol, spec.target, most,
                         random)
        parts.append(grown(part, amplitude))
    clean = observe(protocol, [*form.material, *parts])
    for k in range(len(parts) if spec.what == "pair" else 0):
        other = parts[1 - k]
        known = with_term(form, other, reach(protocol, form.material, other))
        if misfit(known, protocol, clean, sd(clean), random) < 25:  # else one term would do for both
            raise Unreachable
    return form, protocol, clean, noise, parts, None


def make(spec: Spec, seed: int, out: pathlib.Path) -> str:
    """Writes the case of a specification below out/cases and out/truths; its name. A case that is there stays."""
    stream = [seed, zlib.crc32(f"{spec.what} {spec.base}".encode()), int(spec.target), spec.number]
    random = np.random.default_rng(stream)
    name = f"{int(random.integers(1 << 40)):010x}"
    if (out / "cases" / name / SEAL).exists():
        return name
    for attempt in range(200):
        try:
            form, protocol, clean, noise, parts, error = hide(spec, np.random.default_rng([*stream, attempt]))
            break
        except (Unreachable, ArithmeticError):
            continue
    else:
        raise RuntimeError(f"nothing that {spec} asks for can be reached")
    sd = noise.sd(protocol, clean)
    noisy = clean + sd * random.standard_normal(len(clean))
    material = [*form.material, *parts]
    grids = [np.linspace(0, reach(protocol, material, part), GRID) for part in parts]
    free = [level_is_free(spec.base, part.invariant) for part in parts]
    errors, chi2 = oracle(form, protocol, clean, sd, noisy, parts, grids, free, random) if parts else ([], 0.0)
    truth = {"what": spec.what, "base": spec.base, "lambda": spec.target, "noise": spec.noise, "stated": spec.stated,
             "seed": seed, "index": spec.number, "attempts": attempt + 1,
             "base_parameters": [[part.invariant, part.law, part.values] for part in form.material],
             "rig": None if error is None else {**error._asdict(), "curve": protocol[error.curve].name},
             "terms": [{"invariant": part.invariant, "law": part.law, "parameters": part.values, "free_level": level,
                        "x": [round(float(v), 6) for v in grid],
                        "slope": [float(f"{v:.6g}") for v in laws.slope(part.law, grid, part.values)],
                        "oracle_error": oracle_error}
                       for part, grid, level, oracle_error in zip(parts, grids, free, errors)],
             "oracle_chi2": chi2, "rows": len(clean),
             "rivals": rivals(form, protocol, clean, sd, parts[0], invariants(spec.base)) if spec.what == "single" else {}}
    write_case(out / "cases", out / "truths", name, spec.base, protocol, noisy, noise if spec.stated else None, truth)
    return name
