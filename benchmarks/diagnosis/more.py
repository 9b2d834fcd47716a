"""Scenarios beside those of benchmarks/diagnosis/run, 34 of which a coarse tube's data can show: what is hidden at four times what they just show."""
import dataclasses

BANDS = {"inlet half": "to: 0.5", "outlet half": "from: 0.5", "middle third": "from: 0.33, to: 0.67"}


@dataclasses.dataclass
class Hidden:
    name: str  # of the effect, or the number's place in the case
    where: str = ""  # the part of the wall; empty: where these data show it best
    number: str = ""  # of several that the effect has, this one
    band: str = ""  # where along the vessel it acts; empty: everywhere


@dataclasses.dataclass
class More:
    name: str
    kind: str
    hidden: list
    wrong: str = ""  # of the inputs


CONTACT, SPRING, DAMPER = Hidden("contact"), Hidden("visco_elastic", "spine", "stiffness"), Hidden("solid.support.regions.spine.damping")
NORMAL, RING, PRESSURE = Hidden("normal_visco_elastic", "spine", "stiffness"), Hidden("loose_ring"), Hidden("external_pressure")
AXIAL, FIBRES, STIFFER, THICKER = Hidden("axial_tension"), Hidden("fibres"), Hidden("stiffness_factor"), Hidden("thickness_factor")
TANGENTIAL = Hidden("tangential_visco_elastic", "", "stiffness")


def in_band(hidden, band):
    return dataclasses.replace(hidden, band=band)


MORE = [
    More("contact_and_loose_ring", "pair", [CONTACT, RING]),
    More("contact_and_axial_tension", "pair", [CONTACT, AXIAL]),
    More("contact_and_fibres", "pair", [CONTACT, FIBRES]),
    More("spring_and_loose_ring", "pair", [SPRING, RING]),
    More("spring_and_external_pressure", "pair", [SPRING, PRESSURE]),
    More("spring_and_tangential_spring", "pair", [SPRING, TANGENTIAL]),
    More("normal_spring_and_fibres", "pair", [NORMAL, FIBRES]),
    More("stiffer_wall_and_external_pressure", "pair", [STIFFER, PRESSURE]),
    More("external_pressure_and_axial_tension", "pair", [PRESSURE, AXIAL]),
    More("thicker_wall_and_loose_ring", "pair", [THICKER, RING]),
    More("spring_and_fibres", "pair", [SPRING, FIBRES]),
    More("normal_spring_and_axial_tension", "pair", [NORMAL, AXIAL]),
    More("damper", "rate", [DAMPER]),
    More("normal_damper", "rate", [Hidden("normal_visco_elastic", "spine", "damping")]),
    More("tangential_damper", "rate", [Hidden("tangential_visco_elastic", "", "damping")]),
    More("more_damping_opposite", "rate", [Hidden("solid.support.regions.opposite.damping")]),
    More("viscosity_of_the_wall", "rate", [Hidden("solid.viscosity")]),
    More("spring_and_damper", "rate", [SPRING, DAMPER]),
    More("spring_in_inlet_half", "place", [in_band(SPRING, "inlet half")]),
    More("spring_in_outlet_half", "place", [in_band(SPRING, "outlet half")]),
    More("contact_in_inlet_half", "place", [in_band(CONTACT, "inlet half")]),
    More("contact_in_outlet_half", "place", [in_band(CONTACT, "outlet half")]),
    More("spring_in_middle_third", "place", [in_band(SPRING, "middle third")]),
    More("contact_in_middle_third", "place", [in_band(CONTACT, "middle third")]),
    More("wall_stiffer_in_inlet_half", "place", [Hidden("stiffness_factor", "inlet half")]),
    More("wall_stiffer_in_outlet_half", "place", [Hidden("stiffness_factor", "outlet half")]),
    More("spring_on_the_other_side", "place", [Hidden("solid.support.regions.opposite.stiffness")]),
    More("more_inflow_contact", "inputs", [CONTACT], "more_inflow"),
    More("more_inflow_external_pressure", "inputs", [PRESSURE], "more_inflow"),
    More("less_compliance_contact", "inputs", [CONTACT], "less_compliance"),
    More("less_compliance_axial_tension", "inputs", [AXIAL], "less_compliance"),
    More("less_compliance_spring", "inputs", [SPRING], "less_compliance"),
    More("wall_stiffer_damper", "inputs", [DAMPER], "wall_stiffer"),
    More("wall_softer_loose_ring", "inputs", [RING], "wall_softer"),
]
