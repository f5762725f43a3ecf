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


#: Contact law → load, shortening and deflection of its blades.
CURVES = {"elastica": elastica.up_to_shortening, "beam_column": elastica.up_to_shortening_with_small_slopes}
NAMES = {"shortening": "Axial shortening δ [mm]", "deflection": "Lateral deflection Δ [mm]"}


def into(panel, line, what="shortening", every_friction=True):
    """Shortening or deflection of a blade over its load, a curve for each friction of the atlas."""
    atlas = line.atlas
    if what not in NAMES:
        raise AtlasError(f"{what!r}: a blade's picture is one of {' and '.join(NAMES)}")
    law = atlas.scene["contact"]["law"]
    if law not in CURVES:
        raise AtlasError(f"{atlas.path}: its contact law is {law}, under which blades are rigid; "
                         f"{' and '.join(CURVES)} have curves to draw")
    blades = line.scene["blades"]
    length, thickness = blades["length"], float(line.value("thickness"))
    rigidity = blades["youngs_modulus"] * blades["width"] * thickness**3 / 12.0  # EI [N m²]
    unit = rigidity / length**2  # the force that F L²/EI counts [N]
    frictions = atlas.axis("friction") if every_friction else [float(line.value("friction"))]
    colours = style.plt.get_cmap(style.SEQUENTIAL)(np.linspace(0.0, 0.88, len(frictions)))
    for friction, colour in zip(frictions, colours):
        load, shortening, deflection = CURVES[law](friction, limit_of(atlas))
        values = shortening if what == "shortening" else deflection
        if friction == 0.0:
            load[0] = elastica.EULER_LOAD  # a column stands straight below it
            load, values = (np.concatenate([[0.0], each]) for each in (load, values))
        panel.plot(unit * load, 1e3 * length * values, color=colour, label=f"friction {friction:g}")
    euler = elastica.EULER_LOAD * unit
    panel.axvline(euler, color=style.GREY, lw=0.9, ls=(0, (4, 3)), label=f"Euler load {euler:.3g} N")
    panel.set_xlabel("Axial load F [N]")
    panel.set_ylabel(NAMES[what])
    panel.set_xlim(left=0)
    panel.set_ylim(bottom=0)


def limit_of(atlas):
    """δ/L up to which a blade is drawn."""
    return atlas.scene.get("validity", {}).get("max_shortening", 0.5)


def draw(options):
    with AtlasFile(options.source) as atlas:
        wanted = command_line.wanted(options, atlas.axes)
        line = atlas.line(**wanted)
        figure, (panels,) = style.subplots(options, 1, 2, (9.0, 4.2))
        for panel, what in zip(panels, NAMES):
            into(panel, line, what, every_friction="friction" not in wanted)
        style.legend(panels[-1 if style.is_narrow(options) else 0], options, place="upper left")
        blades = line.scene["blades"]
        size = " × ".join(f"{1e3 * value:g}"
                          for value in (blades["length"], blades["width"], float(line.value("thickness"))))
        style.title(figure, atlas, f"Blade {size} mm, up to δ/L = {limit_of(atlas):g}")
        style.save(figure, options)


def main(arguments_given):
    command_line.run(draw, command_line.parser(__doc__).parse_args(arguments_given))
