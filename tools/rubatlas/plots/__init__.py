"""Pictures of atlases, orbits, branches and studies: each kind a module with `main(arguments)` and `draw(options)`."""

#: Kind → what it shows. The commands, the gallery and their tests go by this list.
KINDS = {
    "all": "every picture that an atlas and its maps have to show, into a folder",
    "bifurcation": "x and y at the Poincaré sections, and the maximum displacement, over the speed ratio",
    "stack": "bifurcation diagrams one above the other, one for each value of a parameter",
    "waterfall": "spectrum of x over the speed ratio",
    "displacement": "maximum displacement over the clearance, one curve per value of a parameter",
    "map": "maximum displacement and class of motion over the speed ratio and a parameter",
    "margin": "distance to the nearest change of motion and to the predicted grazing, over speed ratio and a parameter",
    "signature": "signs of rubbing in the spectrum over the speed ratio, before the displacement passes a limit",
    "spectrum": "spectrum of x of one point",
    "orbit": "orbit of one point with its sections, and the force on each blade; or several orbits",
    "blade": "a blade's shortening and deflection over its load",
    "safe_speeds": "bands of the speed ratio that keep given limits, with separation margins",
    "basins": "the attractor that each initial state leads to",
    "branch": "periodic orbits over a quantity, stable or not, with their bifurcations; curves of bifurcations",
    "effect": "sections and maximum displacement without an effect and with it",
    "grazing": "how hard a grazing contact kicks the rotor, by an experiment with the program",
    "accuracy": "error over CPU time and right-hand sides, method by method",
}
