# SPDX-License-Identifier: GPL-3.0-or-later
# Peak force of two single storeys over gap, restitution, impact stiffness and period, under each
# record.

records='ELCENTRO_1940_NS NAPA_2014_68150_HNE NAPA_2014_68150_HNN
RIDGECREST_2019_CLC_090 RIDGECREST_2019_CLC_360'

# values PARAMETER: what it takes, with its unit.
values() {
    case $1 in
    gap) awk 'BEGIN { for (i = 0; i <= 30; i++) print 10 * i "mm" }' ;;
    e) awk 'BEGIN { for (i = 2; i <= 20; i++) print i / 20 }' ;;
    k) awk 'BEGIN { for (i = 0; i <= 18; i++) print 10 ^ (8 + i / 6) "N/m^1.5" }' ;;
    T) awk 'BEGIN { for (i = 2; i <= 40; i++) print i / 20 "s" }' ;;
    esac
}

# Without impact the force is not there: 0. Columns: parameter, record, value, peak force [kN],
# impacts.
for parameter in gap e k T; do
    for record in $records; do
        for value in $(values $parameter); do
            simulate study $here/study.deck -D record="$record.AT2" -D "$parameter=$value"
            force=$(value study contacts force)
            number=$(echo "$value" | sed -E 's/(mm|s|N.*)$//')
            echo "$parameter $record $number $force $(value study contacts impacts)"
        done
        echo
        echo
    done
done >"$work/forces"
draw 620

# Rows of some values, a column a record, in MN.
awk "$format"'
    NF {
        force[$1, $2, $3 + 0] = $4 == "nan" || $5 == 0 ? "-" : number($4 / 1000, 3)
    }
    END {
        n = split("'"$(echo $records)"'", record, " ")
        m = split("gap:0 gap:20 gap:50 gap:100 gap:200 e:0.1 e:0.4 e:0.65 e:1 " \
            "k:1e8 k:1e9 k:1e10 k:1e11 " \
            "T:0.1 T:0.3 T:0.5 T:0.8 T:1 T:1.2 T:2", row, " ")
        for (i = 1; i <= m; i++) {
            split(row[i], p, ":")
            line = "study\t| " p[1] " = " p[2] " |"
            for (j = 1; j <= n; j++) {
                if (!((p[1], record[j], p[2] + 0) in force)) {
                    print "study.sh: no run with " row[i] >"/dev/stderr"
                    exit 1
                }
                line = line " " force[p[1], record[j], p[2] + 0] " |"
            }
            print line
        }
    }' "$work/forces"
