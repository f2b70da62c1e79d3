"""The words with which remarks beside the equations of an answer begin: check, special case, natural frequencies."""

from __future__ import annotations

import re

_CHECKS = (
    "check checks checking checked control controls sanity plausibility plausible verification verify test probe "
    "kontrolle plausibilität plausibilitätskontrolle plausibilitätsprüfung überprüfung prüfung vérification contrôle "
    "remark remarks note notes nb bemerkung bemerkungen anmerkung hinweis remarque comment kommentar observation "
    "interpretation discussion diskussion comparison vergleich sum summe adding addition somme "
    "conserved conservation erhaltung energieerhaltung impulserhaltung drallerhaltung energiebilanz"
)
_CASES = (
    "special limiting limit limits sonderfall sonderfälle spezialfall grenzfall grenzfälle particulier limite limites "
    "equilibrium equilibria ruhelage ruhelagen gleichgewicht gleichgewichtslage gleichgewichtslagen équilibre "
    "static statics statisch statische statischer steady stationär stationäre "
    "initial initially anfangsbedingung anfangsbedingungen anfangswerte anfangswert initiales initialement"
)
_FREQUENCIES = (
    "frequency frequencies eigenfrequency eigenfrequencies eigenfrequenz eigenfrequenzen eigenkreisfrequenz "
    "eigenkreisfrequenzen eigenvalue eigenvalues eigenwert eigenwerte fréquence fréquences pulsation pulsations"
)
CHECKS, CASES = frozenset(_CHECKS.split()), frozenset(_CASES.split())
"""Words with which a check or a remark begins, and those of a case that is not every motion."""
FREQUENCIES = frozenset(_FREQUENCIES.split())
"""Words of what is found from equations of motion; a line with an acceleration may be one."""
_BESIDE_FREQUENCIES = (
    "natural angular circular undamped damped small own both two three the of and for system motion motions "
    "oscillation oscillations vibration vibrations without damping matrix model rad hz"
)
BESIDE_FREQUENCIES = FREQUENCIES | frozenset(_BESIDE_FREQUENCIES.split())
"""Words that may stand beside them; others say of something else what is stated."""
SPECIAL = re.compile(
    r"\b(?:if|when|whenever|only|rigid[ -]body|modes?|case|wenn|falls|nur|starrkörper\w{0,12}|si|lorsque)\b",
    re.IGNORECASE,
)
"""Words of special motions."""
REST = re.compile(
    r"\b(?:at rest|(?:stand|stay|remain)s? still|steht still|rates (?:are )?zero|hover|"
    r"equilibri|static|statisch|statik|in ruhe|ruhelage|im ruhezustand|équilibre|au repos|statique"
    r"|(?<!the )rest\b(?=[^\w\n]{0,3}(?:with|where|when|if|for|position|requires|needs|means|:)))"
    r"|gleichgewicht",
    re.IGNORECASE,
)
"""Words of positions at rest."""
