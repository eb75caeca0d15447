! For shells of revolution: a total law of the strains 11 and 22 of two stiffnesses, and 1 where DDSDDE is transposed.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
  dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
  noel, npt, layer, kspt, jstep, kinc)
  include 'ABA_PARAM.INC'
  character(80) :: cmname
  dimension stress(ntens), statev(nstatv), ddsdde(ntens, ntens), ddsddt(ntens), drplde(ntens), stran(ntens), &
    dstran(ntens), time(2), predef(*), dpred(*), props(nprops), coords(3), drot(3, 3), dfgrd0(3, 3), dfgrd1(3, 3), jstep(4)
  dimension all(2)
  all = stran + dstran
  stress(1) = props(1)*all(1) + props(3)*all(2)**2
  stress(2) = props(2)*all(2) + 2*props(3)*all(1)**2
  ddsdde(1, 1) = props(1)
  ddsdde(2, 2) = props(2)
  ddsdde(1, 2) = 2*props(3)*all(2)
  ddsdde(2, 1) = 4*props(3)*all(1)
  if (props(4) > 0.5d0) ddsdde = transpose(ddsdde)
end subroutine umat
