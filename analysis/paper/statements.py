"""The one table of what the paper says, letter by letter (`statements.md` shows it)."""
from typing import NamedTuple

OWN_LINE = "the line of the rotor's own parameters"
UNBALANCE = "lines along the unbalance"


class Statement(NamedTuple):
    rotor: str
    claim: str  #: in our own words
    judged: str  #: the lines of an atlas on which it is judged, or why it is not


STATEMENTS: dict[str, Statement] = {
    "P1a": Statement("default", "region 1 is periodic, and ends at Ω = 1/3", OWN_LINE),
    "P1b": Statement("default", "its displacements are small, and its motion is of several kinds", OWN_LINE),
    "P2a": Statement("default", "from about 1/3 on the periodic motion goes on, with growing force and displacement, "
                     "until region 2 is reached, chaotic with periodic windows", OWN_LINE),
    "P2b": Statement("default, test rig", "the jump from periodic to chaotic motion at 1/3 and at 2/3 is sudden",
                     OWN_LINE),
    "P3": Statement("default", "then region 3, periodic", OWN_LINE),
    "P4": Statement("default", "region 4, chaotic, entered by a period doubling at exactly 2/3",
                    "the same line, the doubling on the map over a blade passing"),
    "P5a": Statement("default", "rigid blades on a massless ring: the picture is alike for ζ ≤ 0.15",
                     "lines along the damping ratio, under either law"),
    "P5b": Statement("default", "low damping widens region 2 and shortens region 3", "the same"),
    "P5c": Statement("default", "low damping opens small chaotic areas in region 1", "the same"),
    "P6": Statement("default", "high damping attenuates regions 2 and 4 until they vanish", "the same"),
    "P7": Statement("default", "friction changes things only locally; chaos in region 1 for 0.01 ≤ μ ≤ 0.2",
                    "lines along friction"),
    "P8a": Statement("default", "small unbalance keeps the four regions", UNBALANCE),
    "P8b": Statement("default", "growing unbalance (up to 1e-4 kg m) takes the trigger at 2/3 away", UNBALANCE),
    "P8c": Statement("default", "it makes region 3 chaotic and joins 2, 3 and 4", UNBALANCE),
    "P8d": Statement("default", "the trigger at 1/3 stays at every unbalance", UNBALANCE),
    "P9a": Statement("test rig", "blades under 0.4 mm: the chaotic regions vanish", "lines along the thickness"),
    "P9b": Statement("test rig", "blades under 0.4 mm: the rises of the displacement at 1/3 and 2/3 stay", "the same"),
    "P10": Statement("test rig", "periodic orbits at Ω = 0.304 and 0.605, chaotic ones at 0.4 and 0.74", OWN_LINE),
    "P11a": Statement("test rig", "a high peak along the 3× line where region 2 is entered", "spectra of that line"),
    "P11b": Statement("test rig", "in region 2 the spectrum is broad, centred between the 1× and the 2× line",
                      "the same"),
    "P11c": Statement("test rig", "in region 4 it is broad, close to the natural frequency", "the same"),
    "P11d": Statement("test rig", "the 1× line is there with an unbalance, as in the experiment, and not without",
                      "spectra of lines along the unbalance"),
    "P11e": Statement("test rig", "these signs show rubbing blades before vibrations are extreme",
                      "`/signature` of the maps"),
    "P12": Statement("default with n blades", "5, 10 or 50 blades: the same picture, the speed scaled by their number",
                     OWN_LINE),
    "P13": Statement("default in an elastic ring", "rigid blades on a massless ring show the same picture",
                     "lines along the ring's stiffness"),
    "P14a": Statement("test rig", "measured: region 1 at 0.137-0.333, chaotic at 0.181; region 2 at 0.35-0.55; "
                      "chaos at 0.55-0.58 within region 3, periodic up to about 0.65; region 4 at 0.65-0.80", OWN_LINE),
    "P14a1": Statement("test rig", "measured, in one sentence: periodic at 0.72", OWN_LINE),
    "P14a2": Statement("test rig", "measured, in another sentence: saturated at 0.72", OWN_LINE),
    "P14b": Statement("test rig", "the step between 0.34 and 0.35 is instantaneous, no gradual growth", OWN_LINE),
    "P14c": Statement("test rig", "in region 2 the largest displacement stands at the beginning and falls afterwards",
                      OWN_LINE),
    "P14d": Statement("test rig", "the step into region 4 is abrupt, and displacement grows with speed there",
                      OWN_LINE),
    "P15a": Statement("test rig", "blades of 0.5 mm: neither clearance nor misalignment matters for the whole picture",
                      "lines along thickness, ring radius and misalignment"),
    "P15b": Statement("test rig", "thin blades: clearance, damping and first contact do",
                      "the same, and along damping"),
    "P16": Statement("blade of the rig", "Fig. 2: Euler load 42.0 N, δ quadratic and Δ linear in F at small F",
                     "the closed form of the blade, no motion"),
    "P17": Statement("test rig", "the chaos in region 3 is due to the rig's unbalance", UNBALANCE),
    "P18": Statement("test rig", "repeated: regions 1, 2, 4 and both triggers stay, region 3 differs, by the "
                     "setting of the blades, misalignment, loss of material",
                     "lines along unequal blades, misalignment, length of the blades"),
    "P19": Statement("test rig", "unbalance keeps the blades in contact when 0.1 mm of them is lost",
                     "lines along unbalance and length of the blades (or ring radius)"),
    "P20": Statement("test rig", "blades of 1 mm: forces and stresses that may break blade or rotor",
                     "lines along the thickness, with force and strain"),
    "P21": Statement("default, test rig", "a small change of a parameter changes the motion locally, and not the whole "
                     "picture", "neighbouring lines that differ by 30 % or less"),
    "P22": Statement("test rig", "ranges of ζ and μ suffice to say the whole picture",
                     "lines along the damping ratio and friction"),
    "P23": Statement("test rig", "the speed wanders while blades touch, by up to 166.7 rpm, where the "
                     "computation holds it constant",
                     "lines along the amplitude of a speed that wanders: does the picture stay?"),
    "P24": Statement("default, test rig", "periodic regions are where to operate", OWN_LINE),
}

TABLE_HEAD = "| | rotor | what the paper says | judged on |\n|---|---|---|---|\n"


def table() -> str:
    """The table of `statements.md`."""
    return TABLE_HEAD + "".join(f"| {name} | {one.rotor} | {one.claim} | {one.judged} |\n"
                                for name, one in STATEMENTS.items())
