// SPDX-License-Identifier: GPL-3.0-or-later
#include "result/seal_type.h"

// Lists of users of a scale are compounds of a reference and a number, as the high-level library
// makes them.
static bool is_uses(hid_t type) {
    return H5Tget_nmembers(type) == 2 && H5Tget_member_class(type, 0) == H5T_REFERENCE &&
           H5Tget_member_class(type, 1) == H5T_INTEGER &&
           H5Tget_member_offset(type, 1) + sizeof(int) <= H5Tget_size(type);
}

static bool is_list_of_references(hid_t type) {
    hid_t item = H5Tget_super(type);
    const bool is = item >= 0 && H5Tequal(item, H5T_STD_REF_OBJ) > 0;
    if (item >= 0) {
        H5Tclose(item);
    }
    return is;
}

enum seal_kind seal_kind_of(hid_t type) {
    switch (H5Tget_class(type)) {
        case H5T_INTEGER:
        case H5T_FLOAT:
            return KIND_BYTES;
        case H5T_STRING:
            return H5Tis_variable_str(type) > 0 ? KIND_TEXT : KIND_BYTES;
        case H5T_VLEN:
            return is_list_of_references(type) ? KIND_SCALES : KIND_NONE;
        case H5T_COMPOUND:
            return is_uses(type) ? KIND_USES : KIND_NONE;
        default:
            return KIND_NONE;
    }
}

// Where the bits of a number are and what they mean: with another type the same bytes are other
// values.
static void add_bits(struct checksum_sum *to, hid_t type) {
    H5T_pad_t low = H5T_PAD_ERROR, high = H5T_PAD_ERROR;
    H5Tget_pad(type, &low, &high);
    const uint64_t bits[] = {(uint64_t)H5Tget_order(type), H5Tget_precision(type),
                             (uint64_t)H5Tget_offset(type), (uint64_t)low, (uint64_t)high};
    for (size_t i = 0; i < sizeof bits / sizeof bits[0]; i++) {
        checksum_add_number(to, bits[i]);
    }
}

static void add_float(struct checksum_sum *to, hid_t type) {
    size_t sign = 0, exponent = 0, n_exponent = 0, mantissa = 0, n_mantissa = 0;
    H5Tget_fields(type, &sign, &exponent, &n_exponent, &mantissa, &n_mantissa);
    const uint64_t parts[] = {sign,
                              exponent,
                              n_exponent,
                              mantissa,
                              n_mantissa,
                              H5Tget_ebias(type),
                              (uint64_t)H5Tget_norm(type),
                              (uint64_t)H5Tget_inpad(type)};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        checksum_add_number(to, parts[i]);
    }
}

void seal_add_type(struct checksum_sum *to, hid_t type, enum seal_kind kind) {
    const H5T_class_t class = H5Tget_class(type);
    checksum_add_number(to, (uint64_t)kind);
    checksum_add_number(to, (uint64_t) class);
    if (kind == KIND_BYTES) {
        checksum_add_number(to, H5Tget_size(type));
    }
    if (class == H5T_INTEGER || class == H5T_FLOAT) {
        add_bits(to, type);
    }
    if (class == H5T_INTEGER) {
        checksum_add_number(to, (uint64_t)H5Tget_sign(type));
    } else if (class == H5T_FLOAT) {
        add_float(to, type);
    } else if (class == H5T_STRING) {
        checksum_add_number(to, (uint64_t)H5Tget_cset(type));
        checksum_add_number(to, (uint64_t)H5Tget_strpad(type));
    }
}
