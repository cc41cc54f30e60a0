/* The compiled forms by name. The linked table is generated at build time; one loaded at run time has the
 * same form. */
#pragma once

#ifdef __cplusplus
extern "C" {
#endif

struct ufcx_form;

struct thermocontact_kernel {
    const char* name; /* "elasticity.stiffness": form file and variable in it */
    const char* cell; /* "triangle" */
    int degree;       /* of the Lagrange space of the unknowns */
    struct ufcx_form** form;
};

extern const struct thermocontact_kernel thermocontact_kernels[];
extern const int thermocontact_kernel_count;
extern const char* const thermocontact_kernel_versions;
extern const char* const thermocontact_forms_digest;

#ifdef __cplusplus
}
#endif
