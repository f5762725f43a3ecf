"""Force and displacement of the blade's tip, for the blade and the friction of an atlas (as the paper's Fig. 2).

  rubatlas-plot blade ATLAS.h5 -o PICTURE.png [--thickness 0.0005] [--friction 0.1]

Left the axial shortening, right the lateral deflection, over the axial load; the dashed line is the Euler load of the
frictionless blade. One curve per friction coefficient of the atlas, or the one that is named.
"""
import numpy as np

from rubatlas import command_line
from rubatlas import elastica
from rubatlas import style
from rubatlas.atlas_file import AtlasError, AtlasFile


def draw(options):
    with AtlasFile(options.source) as atlas:
        if atlas.scene["contact"]["law"] != "elastica":
            raise AtlasError(f"{options.source}: its contact law is {atlas.scene['contact']['law']}, "
                             "under which blades are rigid; only elastica has curves to draw")
        wanted = command_line.wanted(options, atlas.axes)
        line = atlas.line(**wanted)
        blades = line.scene["blades"]
        length, thickness = blades["length"], float(line.value("thickness"))
        rigidity = blades["youngs_modulus"] * blades["width"] * thickness**3 / 12.0  # EI [N m²]
        unit = rigidity / length**2  # the force that F L²/EI counts [N]
        euler = elastica.EULER_LOAD * unit
        limit = atlas.scene.get("validity", {}).get("max_shortening", 0.5)
        frictions = [float(line.value("friction"))] if "friction" in wanted else atlas.axis("friction")

        figure, panels = style.plt.subplots(1, 2, sharex=True, figsize=(9.0, 4.2))
        colours = style.plt.get_cmap(style.SEQUENTIAL)(np.linspace(0.0, 0.88, len(frictions)))
        for friction, colour in zip(frictions, colours):
            load, shortening, deflection = elastica.up_to_shortening(friction, limit)
            if friction == 0.0:
                load[0] = elastica.EULER_LOAD  # a column stands straight below it
                load, shortening, deflection = (np.concatenate([[0.0], values]) for values in (load, shortening, deflection))
            for panel, values in zip(panels, (shortening, deflection)):
                panel.plot(unit * load, 1e3 * length * values, color=colour, label=f"friction {friction:g}")
        for panel, name in zip(panels, ("Axial shortening δ [mm]", "Lateral deflection Δ [mm]")):
            panel.axvline(euler, color=style.GREY, lw=0.9, ls=(0, (4, 3)), label=f"Euler load {euler:.3g} N")
            panel.set_xlabel("Axial load F [N]")
            panel.set_ylabel(name)
            panel.set_xlim(left=0)
            panel.set_ylim(bottom=0)
        panels[0].legend(loc="upper left")
        style.title(figure, atlas, f"Blade {1e3 * length:g} × {1e3 * blades['width']:g} × {1e3 * thickness:g} mm, "
                                   f"up to δ/L = {limit:g}")
        style.save(figure, options)


def main(arguments_given):
    command_line.run(draw, command_line.parser(__doc__).parse_args(arguments_given))
