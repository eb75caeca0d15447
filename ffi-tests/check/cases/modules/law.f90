! Linear elastic; the stiffness is in a module of a file in a folder below, which needs another one.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
    dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
    noel, npt, layer, kspt, jstep, kinc)
  use elastic, only: stiffness
  include 'aba_param.inc'
  include 'sizes.inc'
  character(80) :: cmname
  dimension stress(ntens), statev(nstatv), ddsdde(ntens, ntens), ddsddt(ntens), drplde(ntens), stran(ntens), &
    dstran(ntens), time(2), predef(1), dpred(1), props(nprops), coords(3), drot(3, 3), dfgrd0(3, 3), dfgrd1(3, 3), jstep(4)
  ddsdde = stiffness(props(1), props(2), min(ntens, largest))
  stress = stress + matmul(ddsdde, dstran)
end subroutine umat
