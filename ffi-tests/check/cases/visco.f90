! A linear solid with one relaxing shear modulus, as a rate law, with thermal expansion.
! PROPS: bulk modulus, shear modulus, relaxing shear modulus, its time, expansion. STATEV: the relaxing stress.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
    dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
    noel, npt, layer, kspt, jstep, kinc)
  implicit none
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep(4), kinc
  character(80) :: cmname
  real(8) :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd, scd, rpl, ddsddt(ntens), drplde(ntens)
  real(8) :: drpldt, stran(ntens), dstran(ntens), time(2), dtime, temp, dtemp, predef(*), dpred(*), props(nprops)
  real(8) :: coords(3), drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)
  real(8) :: bulk, shear, relaxing, period, expansion, kept, grown, trace, old(6), new(6), change(6)
  integer :: i, j
  bulk = props(1)
  shear = props(2)
  relaxing = props(3)
  period = props(4)
  expansion = props(5)
  kept = exp(-dtime/period)
  grown = (1 - kept)*period/dtime
  call rotsig(statev, drot, old, 1, ndi, nshr)
  trace = sum(dstran(:ndi))
  change = 0
  change(:ntens) = dstran/2
  change(:ndi) = dstran(:ndi) - trace/3
  new = kept*old + 2*relaxing*grown*change
  stress = stress + 2*shear*change(:ntens) + new(:ntens) - old(:ntens)
  stress(:ndi) = stress(:ndi) + bulk*(trace - 3*expansion*dtemp)
  statev(:ntens) = new(:ntens)
  ddsdde = 0
  do i = 1, ntens
    ddsdde(i, i) = shear + relaxing*grown
  end do
  do i = 1, ndi
    do j = 1, ndi
      ddsdde(i, j) = ddsdde(i, j)*2 + bulk - 2*(shear + relaxing*grown)/3
    end do
  end do
  ddsddt = 0
  ddsddt(:ndi) = -3*bulk*expansion
end subroutine umat
