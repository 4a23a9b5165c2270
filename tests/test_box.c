// Tests the boxes of the tree builder.
#include "accel/box.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

// The builder's results depend on this rule, whichever instruction it compiles to.
static void the_larger_of_two_lanes_is_the_second_unless_the_first_is_larger(void **state)
{
    (void)state;
    const float values[] = {0, -0.0f, 1, -1, 1e30f, 1e-42f, INFINITY, -INFINITY, NAN};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        for (size_t k = 0; k < sizeof values / sizeof *values; k++) {
            float a = values[i], b = values[k];
            glint_float4 larger =
                glint_larger4((glint_float4){a, b, a, b}, (glint_float4){b, a, b, b});
            const float expected[4] = {a > b ? a : b, b > a ? b : a, a > b ? a : b, b};
            assert_memory_equal(&larger, expected, sizeof expected);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_larger_of_two_lanes_is_the_second_unless_the_first_is_larger),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
