"""The sections in the order of the page. A new one is a module with a SECTION, and a line here."""

from report_parts import (
    agreement,
    audits,
    constants,
    error_curve,
    extremes,
    invariance,
    known_answers,
    matrix,
    orders,
    speed,
    tradeoff,
)
from report_parts.section import Section

SECTIONS: dict[str, Section] = {
    module.SECTION.name: module.SECTION
    for module in (
        agreement,
        matrix,
        orders,
        known_answers,
        audits,
        constants,
        invariance,
        extremes,
        error_curve,
        tradeoff,
        speed,
    )
}
