/* The built-in law files of forms/laws, with what they say of themselves. Generated at build time. */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

struct thermocontact_law {
    const char* kind;        /* "compliance" */
    const char* text;        /* of the file */
    const char* description; /* JSON, of forms/describe.py */
};

extern const struct thermocontact_law thermocontact_laws[];
extern const int thermocontact_law_count;
extern const char* const thermocontact_law_tools; /* what kernels are made with and from */

#ifdef __cplusplus
}
#endif
