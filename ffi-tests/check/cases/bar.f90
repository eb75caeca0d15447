! For trusses: elastic, then plastic with linear hardening. PROPS: E, yield stress, H, and 1 where DDSDDE stays elastic.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
  dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, dfgrd0, dfgrd1, &
  noel, npt, layer, kspt, jstep, kinc)
  include 'ABA_PARAM.INC'
  character(80) :: cmname
  dimension stress(ntens), statev(nstatv), ddsdde(ntens, ntens), ddsddt(ntens), drplde(ntens), stran(ntens), &
    dstran(ntens), time(2), predef(*), dpred(*), props(nprops), coords(3), drot(3, 3), dfgrd0(3, 3), dfgrd1(3, 3), jstep(4)
  young = props(1)
  trial = stress(1) + young*dstran(1)
  over = abs(trial) - props(2) - props(3)*statev(1)
  ddsdde(1, 1) = young
  if (over > 0) then
    slip = over/(young + props(3))
    trial = trial - sign(young*slip, trial)
    statev(1) = statev(1) + slip
    if (props(4) < 0.5d0) ddsdde(1, 1) = young*props(3)/(young + props(3))
  end if
  stress(1) = trial
end subroutine umat
