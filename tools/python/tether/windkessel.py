"""What lies beyond an outlet, as Tether's fluid has it."""


class Windkessel:
    """One step of a proximal resistance, then a compliance with a distal resistance beside it, by implicit Euler: the pressure at the outlet is
    `offset + slope Q`, Q the flow that leaves at the end of the step.

    proximal, distal: resistances; compliance; distal_pressure; stored: pressure of the compliance as the step begins; dt: its duration.
    """

    def __init__(self, proximal, distal, compliance, distal_pressure, stored, dt):
        share = dt / compliance
        whole = 1 + share / distal
        self.offset, self.slope = (stored + share * distal_pressure / distal) / whole, proximal + share / whole
        self.proximal = proximal

    def stored(self, flow):
        """Pressure of the compliance at the end of the step, if that much leaves."""
        return self.offset + (self.slope - self.proximal) * flow
