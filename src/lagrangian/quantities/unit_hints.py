"""Suggestions for names that are not units here, and reasons why some units of other books are refused."""

from __future__ import annotations

import re

from lagrangian.errors import did_you_mean
from lagrangian.quantities.units import lookup, units

OFFSET = {
    **dict.fromkeys(("degC", "celsius", "Celsius", "centigrade"), ("273.15 K", "1 K")),
    **dict.fromkeys(("degF", "fahrenheit", "Fahrenheit"), ("255.37 K", "5/9 K")),
}
"""Temperatures: their zero, and the size of one degree."""

LOGARITHMS = frozenset(("dB", "dBm", "Np", "decibel"))

_MEANT = {
    "kg": "Kg KG Kgs kgs KGs kilo kilos kilogramme kilogrammes",
    "g": "gr gm gms GM grm gramme grammes",
    "t": "MT",
    "lb (a mass) or lbf (a force)": "pound pounds lbs LB Lb LBS",
    "t (1000 kg), or 2000 lb": "ton tons",
    "oz": "ounce ounces",
    "m": "M mtr mtrs mts mt",
    "cm": "CM Cm cms",
    "mm": "MM mms",
    "mm, or 1e6 m": "Mm",
    "g, or 1e9 m": "Gm",
    "mg, or t for 1000 kg": "Mg",
    "km": "KM Km kms",
    "µm": "micron microns mu",
    "s": "sec secs Sec Secs SEC",
    "ms": "msec msecs millisecond milliseconds",
    "µs": "usec microsecond microseconds",
    "h": "hr hrs Hr HR",
    "min": "mins Min MIN",
    "d": "D dy",
    "365.25 d": "yr year years a",
    "7 d": "week weeks wk",
    "deg": "Deg DEG degs dgr",
    "rad": "Rad RAD rads",
    "deg or rad (a gon is 0.9 deg)": "grad gon grade",
    "rev/s": "rps RPS",
    "rpm": "RPM Rpm r",
    "Hz": "HZ hz cps",
    "m/s": "mps",
    "ft/s": "fps",
    "km/h": "kph kmh kmph KPH KMH",
    "knot (a speed) or kN (a force)": "kn kt kts",
    "N": "Newton Newtons",
    "N*m": "Nm NM",
    "N*m*s": "Nms NMS",
    "ft*lbf": "ftlb ftlbs ftlbf lbft lbfft",
    "in*lbf": "inlb inlbs inlbf lbin lbfin",
    "kN": "KN Kn",
    "kgf": "kp kilopond kgwt",
    "MPa": "mpa Mpa MPA",
    "kPa": "kpa Kpa KPa KPA",
    "psi": "PSI Psi",
    "98066.5 Pa": "at",
    "mmHg": "torr Torr",
    "4.184 J": "cal",
    "4184 J": "kcal",
    "735.49875 W": "PS CV",
    "1055.06 J": "BTU Btu",
    "hp": "HP Hp bhp",
    "W*s, or J, which is the same": "Ws",
    "kW*s, or kJ, which is the same": "kWs",
    "cm^3": "cc ccm",
    "3.785411784 L (US) or 4.54609 L (UK)": "gal gallon gallons",
    "L": "ltr Ltr lit",
    "ohm": "Ohm Ohms OHM",
    "A": "amp amps Amp Amps",
    "V": "Volt Volts",
    "1e-4 T": "G Gs gauss Gauss",
    "S": "mho",
    "K": "Kelvin",
    "cm, or 299792458 m/s for the speed of light": "c",
    "µ before a unit, such as µm; 1.66053906660e-27 kg for the atomic mass": "u amu Da",
    "1e-10 m": "Å angstrom",
    "9.80665 m/s^2": "gee g0 gn",
    "1 for 100 %, such as 0.05 for 5 %": "percent",
    "mph": "MPH Mph",
    "kg, km or kN, or 1e3 for a thousand": "k",
}
"""What to write instead of names that occur in notes, drawings and programs."""

LENGTHS = "m, km, cm, mm, µm, nm, in, ft, yd, mi or nmi"
_LONG = "parsec parsecs pc kpc Mpc lightyear lightyears ly au AU fathom furlong league chain rod thou mil mils"
HINTS = {name: f"write {meant}" for meant, names in _MEANT.items() for name in names.split()}

_OFTEN = (
    "kg g t m km cm mm s ms min h d N kN mN MN J kJ W kW Pa kPa MPa Hz kHz rad deg rev rpm A mA V mV ohm Ω F µF H mH "
    "C T Wb S K mol in ft yd mi lb lbm lbf oz slug psi hp mph knot bar atm L mL degree hour minute inch foot newton"
)
_COMMON = _OFTEN.split()


def similar(name: str) -> str | None:
    """Return a suggestion for an unknown unit."""
    if name in HINTS:
        return HINTS[name]
    known = units()
    same = [x for x in known if x.lower() == name.lower()]
    if same:
        common = [x for x in same if x in _COMMON] or same
        return f"write {' or '.join(common[:3])}"
    if name in _LONG.split():
        return f"lengths are in {LENGTHS}"
    if name.endswith("s") and name[:-1] in known:
        unit = name[:-1]  # a symbol has no plural: As is A*s, but bars is bar
        product = unit in _COMMON and not unit.islower() and not unit.endswith("Hz")
        return f"write {unit}*s" if product else f"write {unit}"
    if product := _glued(name):
        return f"write {product}"
    return did_you_mean(name, [*_COMMON, *known])


def _glued(name: str) -> str | None:
    """Find units written without a sign between them, or a power without ^: Nms, kgm2, m2."""
    match = re.fullmatch(r"([^\W\d_]+)([2-9]?)", name)
    if match is None:
        return None
    letters, power = match.groups()
    raised = f"^{power}" if power else ""
    if power and lookup(letters):
        return letters + raised
    for at in range(len(letters) - 1, 0, -1):
        first, second = letters[:at], letters[at:]
        if {first, second} <= {*_COMMON} and units()[first].dimension != units()[second].dimension:
            return f"{first}*{second}{raised}"
    return None


def refusal(name: str) -> tuple[str, str] | None:
    """Return the reason why a unit of many books is refused, and what to write; None for any other name."""
    if name in OFFSET:
        zero, difference = OFFSET[name]
        reason = f"the zero of '{name}' is at {zero}: no factor turns it into kelvins"
        return reason, f"write K; a difference of one degree is {difference}"
    if name == "degK":
        return "kelvins are not counted in degrees", "write K"
    if name in LOGARITHMS:
        return f"'{name}' is a logarithm of a ratio", "write the ratio itself"
    return None
