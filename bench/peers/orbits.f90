! The modal plant for AUTO-07p: periodic orbits under one sinusoidal force, continued in its frequency.
!
! AUTO wants autonomous equations, so the drive is a pair of oscillator states s, c with the limit cycle sin, cos of 2 pi f t.
! States per mode: x = q / L, y = q' / (w L); then the voltage over V0, then s and c. L and V0 bring all states near 1.
!   x' = w y,   y' = -w x - 2 zeta w y + (coupling V + tip F_c + table F s) / (w L)
!   V' = -V / (R C) - sum of coupling q' / C,   F_c = -k max(0, tip . q - gap)^1.5
! PAR(1): drive frequency, Hz. PAR(11): period, s. PAR(12): mean power in the resistor, W.
! The plant is read from `plant.txt`, written by the harness. The first orbit is the linear answer, exact where nothing is struck.

module plant
    implicit none
    double precision, parameter :: tau = 6.283185307179586477d0, length = 1d-4, volt = 10d0
    integer :: modes = 0
    double precision, allocatable :: w(:), ratio(:), table(:), tip(:), coupling(:)
    double precision :: capacitance_f, resistance_ohm, gap_m, contact, amplitude_n, start_hz
contains
    subroutine read_plant()
        character(len=32) :: name
        integer :: file
        open(newunit=file, file='plant.txt', status='old', action='read')
        read(file, *) name, modes
        allocate(w(modes), ratio(modes), table(modes), tip(modes), coupling(modes))
        read(file, *) name, w
        read(file, *) name, ratio
        read(file, *) name, table
        read(file, *) name, tip
        read(file, *) name, coupling
        read(file, *) name, capacitance_f
        read(file, *) name, resistance_ohm
        read(file, *) name, gap_m
        read(file, *) name, contact
        read(file, *) name, amplitude_n
        read(file, *) name, start_hz
        close(file)
        w = tau * w
    end subroutine

    ! Complex amplitudes of the linear answer to F exp(i omega t): modal displacements, and the voltage after them.
    function linear_answer(omega) result(answer)
        double precision, intent(in) :: omega
        complex(kind(1d0)) :: answer(modes + 1), receptance(modes), i_omega
        i_omega = cmplx(0d0, omega, kind(1d0))
        receptance = 1d0 / (w**2 - omega**2 + 2d0 * ratio * w * i_omega)
        answer(modes + 1) = -i_omega * sum(coupling * receptance * table) * amplitude_n &
            / (i_omega * capacitance_f + 1d0 / resistance_ohm + i_omega * sum(coupling**2 * receptance))
        answer(:modes) = receptance * (table * amplitude_n + coupling * answer(modes + 1))
    end function
end module

subroutine func(ndim, u, icp, par, ijac, f, dfdu, dfdp)
    use plant
    implicit none
    integer, intent(in) :: ndim, icp(*), ijac
    double precision, intent(in) :: u(ndim), par(*)
    double precision, intent(out) :: f(ndim)
    double precision, intent(inout) :: dfdu(ndim, ndim), dfdp(ndim, *)
    double precision :: s, c, beta, depth, slope
    integer :: i, n, v
    n = modes
    v = 2 * n + 1
    s = u(v + 1)
    c = u(v + 2)
    beta = tau * par(1)
    depth = max(0d0, length * dot_product(tip, u(:n)) - gap_m)
    f(:n) = w * u(n + 1:2 * n)
    f(n + 1:2 * n) = -w * u(:n) - 2d0 * ratio * w * u(n + 1:2 * n) &
        + (coupling * volt * u(v) - tip * contact * depth * sqrt(depth) + table * amplitude_n * s) / (w * length)
    f(v) = -u(v) / (resistance_ohm * capacitance_f) - length / (capacitance_f * volt) * dot_product(coupling * w, u(n + 1:2 * n))
    f(v + 1) = s + beta * c - s * (s * s + c * c)
    f(v + 2) = -beta * s + c - c * (s * s + c * c)
    if (ijac == 0) return

    dfdu = 0d0
    slope = 1.5d0 * contact * sqrt(depth) * length
    do i = 1, n
        dfdu(i, n + i) = w(i)
        if (slope > 0d0) dfdu(n + i, :n) = -tip(i) * slope * tip / (w(i) * length)
        dfdu(n + i, i) = dfdu(n + i, i) - w(i)
        dfdu(n + i, n + i) = -2d0 * ratio(i) * w(i)
        dfdu(n + i, v) = coupling(i) * volt / (w(i) * length)
        dfdu(n + i, v + 1) = table(i) * amplitude_n / (w(i) * length)
        dfdu(v, n + i) = -length / (capacitance_f * volt) * coupling(i) * w(i)
    end do
    dfdu(v, v) = -1d0 / (resistance_ohm * capacitance_f)
    dfdu(v + 1, v + 1) = 1d0 - 3d0 * s * s - c * c
    dfdu(v + 1, v + 2) = beta - 2d0 * s * c
    dfdu(v + 2, v + 1) = -beta - 2d0 * s * c
    dfdu(v + 2, v + 2) = 1d0 - s * s - 3d0 * c * c
    if (ijac == 1) return

    dfdp(:, 1) = 0d0
    dfdp(v + 1, 1) = tau * c
    dfdp(v + 2, 1) = -tau * s
end subroutine

! The orbit at the start, t from 0 to 1 over one period: the linear answer to F sin. AUTO calls this before anything else.
subroutine stpnt(ndim, u, par, t)
    use plant
    implicit none
    integer, intent(in) :: ndim
    double precision, intent(inout) :: u(ndim), par(*)
    double precision, intent(in) :: t
    complex(kind(1d0)), allocatable :: turned(:)
    double precision :: omega
    if (modes == 0) call read_plant()
    omega = tau * start_hz
    par(1) = start_hz
    par(11) = 1d0 / start_hz
    turned = linear_answer(omega) * exp(cmplx(0d0, tau * t, kind(1d0)))
    u(:modes) = aimag(turned(:modes)) / length
    u(modes + 1:2 * modes) = omega * real(turned(:modes)) / (w * length)
    u(2 * modes + 1) = aimag(turned(modes + 1)) / volt
    u(2 * modes + 2) = sin(tau * t)
    u(2 * modes + 3) = cos(tau * t)
end subroutine

subroutine pvls(ndim, u, par)
    use plant
    implicit none
    integer, intent(in) :: ndim
    double precision, intent(in) :: u(ndim)
    double precision, intent(inout) :: par(*)
    double precision, external :: getp
    par(12) = (volt * getp('NRM', 2 * modes + 1, u))**2 / resistance_ohm
end subroutine

subroutine bcnd()
end subroutine

subroutine icnd()
end subroutine

subroutine fopt()
end subroutine
