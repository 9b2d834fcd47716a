"""What truths are made of: case text of an effect that is hidden."""

FINER = "time: {step: 5.5e-3}\nmesh: {swept: {around: 16, along: 11}}\n"
WITH_PERIOD = ("external_pressure", "moving_tissue")


def nested(path, value):
    """{a: {b: value}} of a.b, as text."""
    text = str(value)
    for name in reversed(path.split(".")):
        text = f"{{{name}: {text}}}"
    return text


def merged(texts):
    """One YAML text of several, whose sections may be the same: the last words win."""
    import json

    import yaml

    def into(a, b):
        for key, value in b.items():
            if isinstance(value, dict) and isinstance(a.get(key), dict):
                into(a[key], value)
            else:
                a[key] = value
        return a

    whole = {}
    for text in texts:
        into(whole, yaml.safe_load(text) or {})
    return json.dumps(whole) + "\n"


def effect_of(name, parameter, amplitude, region="", band=""):
    """A model that has it, as text. parameter: its number's place in the case; region, band: where it acts, if not everywhere."""
    text, owner = [nested(parameter, f"{amplitude:.6g}")], parameter.rsplit(".", 1)[0]
    if owner.startswith("solid.effects."):
        words = [f"type: {name}", f"region: {region}" if region else "", "period: 0.825" if name in WITH_PERIOD else "", band]
        text.append(nested(owner, f"{{{', '.join(word for word in words if word)}}}"))
    return merged(text)
