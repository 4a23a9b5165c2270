// Tests hash tables against a list that is searched from its start.
#include "base/hash_table.h"
#include "base/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { MOST = 500 };

typedef struct sought_value {
    const float (*values)[2];
    const float *value;
} sought_value;

static bool is_value(const void *sought, uint32_t item)
{
    const sought_value *s = sought;
    return s->values[item][0] == s->value[0] && s->values[item][1] == s->value[1];
}

static uint32_t first_equal(const float (*values)[2], uint32_t item)
{
    uint32_t first = 0;
    while (values[first][0] != values[item][0] || values[first][1] != values[item][1]) {
        first++;
    }
    return first;
}

// `kinds`: the number of different coordinates, some of them −0. `poor`: all hashes are alike.
static void check(glint_hash_table *table, uint32_t count, int kinds, bool poor,
                  glint_random *random)
{
    float values[MOST][2];
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++) {
            const int number = (int)(glint_random_number(random) * kinds) - kinds / 2;
            values[i][k] = number == 0 && i % 2 == 0 ? -0.0F : (float)number / 3;
        }
    }
    glint_hash_table_empty(table, count);
    for (uint32_t i = 0; i < count; i++) {
        const sought_value sought = {(const float(*)[2])values, values[i]};
        const uint64_t hash = poor ? UINT64_MAX : glint_hash_floats(3, values[i], 2);
        uint32_t *slot = glint_hash_table_slot(table, hash, is_value, &sought);
        const uint32_t first = first_equal((const float(*)[2])values, i);
        assert_int_equal(*slot, first == i ? GLINT_NO_ITEM : first);
        *slot = first;
    }
    size_t taken = 0;
    for (size_t i = 0; i <= table->mask; i++) {
        taken += table->slots[i] != GLINT_NO_ITEM;
    }
    assert_true(2 * taken <= table->mask + 1);
}

static void equal_items_share_a_slot(void **state)
{
    (void)state;
    glint_random random = {1};
    glint_hash_table table;
    assert_true(glint_hash_table_create(MOST, &table));
    for (int kinds = 1; kinds < 40; kinds++) {
        check(&table, MOST, kinds, false, &random);
        check(&table, 20, kinds, true, &random); // fewer: the table is smaller meanwhile
        check(&table, MOST, kinds, true, &random);
        check(&table, 0, kinds, false, &random);
    }
    glint_hash_table_free(&table);
    glint_hash_table_free(&table); // zero is valid
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(equal_items_share_a_slot)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
