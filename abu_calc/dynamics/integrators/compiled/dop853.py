"""A step of Dormand and Prince's method of order 8 with its error, and the motion within it by order 7.

Source: Hairer, Nørsett & Wanner 1993, Solving Ordinary Differential Equations I, II.5 (coefficients of DOP853, whose
error is estimated by orders 5 and 3) and II.6 (dense output, which takes three more evaluations).
"""

from math import sqrt

from abu_calc.dynamics.integrators.compiled.arrays import Reals, Step, rates, watched

METHOD_ORDER = 8
EXPONENT = -1 / 8
"""Exponent of the error in the factor on the next step."""
STAGES, EXTRA = 12, 3
"""Evaluations of a step, and of its dense output."""
KEPT, LAST, BETWEEN = 16, 12, 7
"""Rows of rates, which of them is that at the end, and rows of the dense output."""


def stages(step: Step, w: Reals) -> None:
    """Compute one step from y, whose rates are the first of k, to the end: thirteen rates.

    The last rates come with the watched numbers there.
    """
    t, h, n, y, par, end, k = step.t, step.h, step.n, step.y, step.par, step.end, step.k
    k1, k2, k3, k4, k5, k6 = k, k[n:], k[2 * n :], k[3 * n :], k[4 * n :], k[5 * n :]
    k7, k8, k9, k10, k11, k12 = k[6 * n :], k[7 * n :], k[8 * n :], k[9 * n :], k[10 * n :], k[11 * n :]
    for i in range(n):
        more = 0.05260015195876773 * k1[i]
        end[i] = y[i] + h * more
    rates(t + 0.05260015195876773 * h, end, par, k2)
    for i in range(n):
        more = 0.0197250569845379 * k1[i] + 0.0591751709536137 * k2[i]
        end[i] = y[i] + h * more
    rates(t + 0.0789002279381516 * h, end, par, k3)
    for i in range(n):
        more = 0.02958758547680685 * k1[i] + 0.08876275643042054 * k3[i]
        end[i] = y[i] + h * more
    rates(t + 0.1183503419072274 * h, end, par, k4)
    for i in range(n):
        more = 0.2413651341592667 * k1[i] - 0.8845494793282861 * k3[i] + 0.924834003261792 * k4[i]
        end[i] = y[i] + h * more
    rates(t + 0.2816496580927726 * h, end, par, k5)
    for i in range(n):
        more = 0.037037037037037035 * k1[i] + 0.17082860872947386 * k4[i] + 0.12546768756682242 * k5[i]
        end[i] = y[i] + h * more
    rates(t + h / 3, end, par, k6)
    for i in range(n):
        more = 0.037109375 * k1[i] + 0.17025221101954405 * k4[i] + 0.06021653898045596 * k5[i]
        more -= 0.017578125 * k6[i]
        end[i] = y[i] + h * more
    rates(t + h / 4, end, par, k7)
    for i in range(n):
        more = 0.03709200011850479 * k1[i] + 0.17038392571223998 * k4[i] + 0.10726203044637328 * k5[i]
        more -= 0.015319437748624402 * k6[i] - 0.008273789163814023 * k7[i]
        end[i] = y[i] + h * more
    rates(t + 4 * h / 13, end, par, k8)
    for i in range(n):
        more = 0.6241109587160757 * k1[i] - 3.3608926294469414 * k4[i] - 0.868219346841726 * k5[i]
        more += 27.59209969944671 * k6[i] + 20.154067550477894 * k7[i] - 43.48988418106996 * k8[i]
        end[i] = y[i] + h * more
    rates(t + 0.6512820512820513 * h, end, par, k9)
    for i in range(n):
        more = 0.47766253643826434 * k1[i] - 2.4881146199716677 * k4[i] - 0.590290826836843 * k5[i]
        more += 21.230051448181193 * k6[i] + 15.279233632882423 * k7[i] - 33.28821096898486 * k8[i]
        more -= 0.020331201708508627 * k9[i]
        end[i] = y[i] + h * more
    rates(t + 3 * h / 5, end, par, k10)
    for i in range(n):
        more = -0.9371424300859873 * k1[i] + 5.186372428844064 * k4[i] + 1.0914373489967295 * k5[i]
        more -= 8.149787010746927 * k6[i] + 18.52006565999696 * k7[i] - 22.739487099350505 * k8[i]
        more += 2.4936055526796523 * k9[i] - 3.0467644718982196 * k10[i]
        end[i] = y[i] + h * more
    rates(t + 6 * h / 7, end, par, k11)
    for i in range(n):
        more = 2.273310147516538 * k1[i] - 10.53449546673725 * k4[i] - 2.0008720582248625 * k5[i]
        more -= 17.9589318631188 * k6[i] - 27.94888452941996 * k7[i] + 2.8589982771350235 * k8[i]
        more -= 8.87285693353063 * k9[i] - 12.360567175794303 * k10[i] - 0.6433927460157636 * k11[i]
        end[i] = y[i] + h * more
    rates(t + h, end, par, k12)
    for i in range(n):
        more = 0.054293734116568765 * k1[i] + 4.450312892752409 * k6[i] + 1.8915178993145003 * k7[i]
        more -= 5.801203960010585 * k8[i] - 0.3111643669578199 * k9[i] + 0.1521609496625161 * k10[i]
        more += 0.20136540080403034 * k11[i] + 0.04471061572777259 * k12[i]
        end[i] = y[i] + h * more
    watched(t + h, end, par, k[LAST * n :], w)


def error(step: Step, absolute: Reals, relative: Reals) -> float:
    """The estimated error of a step in units of what is allowed, root mean square."""
    h, n, y, end, k = step.h, step.n, step.y, step.end, step.k
    k1, k6, k7, k8, k9, k10 = k, k[5 * n :], k[6 * n :], k[7 * n :], k[8 * n :], k[9 * n :]
    k11, k12 = k[10 * n :], k[11 * n :]
    total, coarse = 0.0, 0.0
    for i in range(n):
        allowed = absolute[i] + relative[i] * max(abs(y[i]), abs(end[i]))
        fifth = 0.01312004499419488 * k1[i] - 1.2251564463762044 * k6[i] - 0.4957589496572502 * k7[i]
        fifth += 1.6643771824549864 * k8[i] - 0.35032884874997366 * k9[i] + 0.3341791187130175 * k10[i]
        fifth += 0.08192320648511571 * k11[i] - 0.022355307863886294 * k12[i]
        third = -0.18980075407240762 * k1[i] + 4.450312892752409 * k6[i] + 1.8915178993145003 * k7[i]
        third -= 5.801203960010585 * k8[i] + 0.4226823213237919 * k9[i] + 0.1521609496625161 * k10[i]
        third += 0.20136540080403034 * k11[i] + 0.02265179219836082 * k12[i]
        total += fifth / allowed * (fifth / allowed)
        coarse += third / allowed * (third / allowed)
    if total == 0.0:
        return 0.0
    return h * total / sqrt((total + 0.01 * coarse) * n)


def prepared(step: Step) -> None:
    """Prepare the dense output of a step."""
    t, h, n, y, par, end, k = step.t, step.h, step.n, step.y, step.par, step.end, step.k
    between, at = step.between, step.at
    k1, k6, k7, k8, k9, k10 = k, k[5 * n :], k[6 * n :], k[7 * n :], k[8 * n :], k[9 * n :]
    k11, k12, k13, k14, k15, k16 = k[10 * n :], k[11 * n :], k[12 * n :], k[13 * n :], k[14 * n :], k[15 * n :]
    for i in range(n):
        more = 0.056167502283047954 * k1[i] + 0.25350021021662483 * k7[i] - 0.2462390374708025 * k8[i]
        more -= 0.12419142326381637 * k9[i] - 0.15329179827876568 * k10[i] - 0.00820105229563469 * k11[i]
        more += 0.007567897660545699 * k12[i] - 0.008298 * k13[i]
        at[i] = y[i] + h * more
    rates(t + h / 10, at, par, k14)
    for i in range(n):
        more = 0.03183464816350214 * k1[i] + 0.028300909672366776 * k6[i] + 0.053541988307438566 * k7[i]
        more -= 0.05492374857139099 * k8[i] + 0.00010834732869724932 * k11[i] - 0.0003825710908356584 * k12[i]
        more -= 0.00034046500868740456 * k13[i] - 0.1413124436746325 * k14[i]
        at[i] = y[i] + h * more
    rates(t + h / 5, at, par, k15)
    for i in range(n):
        more = -0.42889630158379194 * k1[i] - 4.697621415361164 * k6[i] + 7.683421196062599 * k7[i]
        more += 4.06898981839711 * k8[i] + 0.3567271874552811 * k9[i] - 0.0013990241651590145 * k13[i]
        more += 2.9475147891527724 * k14[i] - 9.15095847217987 * k15[i]
        at[i] = y[i] + h * more
    rates(t + 7 * h / 9, at, par, k16)
    second, third, fourth, fifth = between[n:], between[2 * n :], between[3 * n :], between[4 * n :]
    sixth, seventh = between[5 * n :], between[6 * n :]
    for i in range(n):
        way = end[i] - y[i]
        between[i] = way
        second[i] = h * k1[i] - way
        third[i] = 2.0 * way - h * (k13[i] + k1[i])
        more = -8.428938276109013 * k1[i] + 0.5667149535193777 * k6[i] - 3.0689499459498917 * k7[i]
        more += 2.38466765651207 * k8[i] + 2.117034582445028 * k9[i] - 0.871391583777973 * k10[i]
        more += 2.2404374302607883 * k11[i] + 0.6315787787694688 * k12[i] - 0.08899033645133331 * k13[i]
        more += 18.148505520854727 * k14[i] - 9.194632392478356 * k15[i] - 4.436036387594894 * k16[i]
        fourth[i] = h * more
        more = 10.427508642579134 * k1[i] + 242.28349177525817 * k6[i] + 165.20045171727028 * k7[i]
        more -= 374.5467547226902 * k8[i] + 22.113666853125306 * k9[i] - 7.733432668472264 * k10[i]
        more -= 30.674084731089398 * k11[i] + 9.332130526430229 * k12[i] - 15.697238121770845 * k13[i]
        more -= 31.139403219565178 * k14[i] + 9.35292435884448 * k15[i] - 35.81684148639408 * k16[i]
        fifth[i] = h * more
        more = 19.985053242002433 * k1[i] - 387.0373087493518 * k6[i] - 189.17813819516758 * k7[i]
        more += 527.8081592054236 * k8[i] - 11.57390253995963 * k9[i] + 6.8812326946963 * k10[i]
        more -= 1.0006050966910838 * k11[i] - 0.7777137798053443 * k12[i] + 2.778205752353508 * k13[i]
        more -= 60.19669523126412 * k14[i] - 84.32040550667716 * k15[i] - 11.99229113618279 * k16[i]
        sixth[i] = h * more
        more = -25.69393346270375 * k1[i] - 154.18974869023643 * k6[i] - 231.5293791760455 * k7[i]
        more += 357.6391179106141 * k8[i] + 93.40532418362432 * k9[i] - 37.45832313645163 * k10[i]
        more += 104.0996495089623 * k11[i] + 29.8402934266605 * k12[i] - 43.53345659001114 * k13[i]
        more += 96.32455395918828 * k14[i] - 39.17726167561544 * k15[i] - 149.72683625798564 * k16[i]
        seventh[i] = h * more


def dense(x: float, n: int, y: Reals, between: Reals, state: Reals) -> None:
    """The state at a share x of a step."""
    for i in range(n):
        state[i] = within(i, x, n, y, between)


def within(i: int, x: float, n: int, y: Reals, between: Reals) -> float:
    """One of its numbers."""
    z = 1.0 - x
    more = between[4 * n + i] + z * (between[5 * n + i] + x * between[6 * n + i])
    more = between[2 * n + i] + z * (between[3 * n + i] + x * more)
    return y[i] + x * (between[i] + z * (between[n + i] + x * more))
