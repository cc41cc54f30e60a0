/// The page's texts, linked into the program (page_parts.c.in).
#pragma once

extern "C" {
extern const char thermocontact_view_page[];     ///< HTML with the places @STYLE@, @RESULTS@, @PROGRAM@
extern const char thermocontact_view_style[];    ///< CSS
extern const char thermocontact_view_program[];  ///< JavaScript, bundled
extern const int thermocontact_view_built;       ///< 0: npm was missing, and style and program are empty
}
