C     Traction and separation with damage: bilinear, of one effective
C     separation that opening and sliding share; closing is elastic.
C     PROPS: stiffness, separation of onset and of failure.
C     STATEV(1): the largest effective separation so far.
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,
     1 RPL,DDSDDT,DRPLDE,DRPLDT,
     2 STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,CMNAME,
     3 NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     4 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,KSTEP,KINC)
      INCLUDE 'ABA_PARAM.INC'
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(NSTATV),DDSDDE(NTENS,NTENS),
     1 DDSDDT(NTENS),DRPLDE(NTENS),STRAN(NTENS),DSTRAN(NTENS),TIME(2),
     2 PREDEF(1),DPRED(1),PROPS(NPROPS),COORDS(3),DROT(3,3),
     3 DFGRD0(3,3),DFGRD1(3,3)
      DIMENSION SEP(3),OPN(3)
      STIFF=PROPS(1)
      ONSET=PROPS(2)
      FAIL=PROPS(3)
      EFF=0.D0
      DO I=1,NTENS
        SEP(I)=STRAN(I)+DSTRAN(I)
        OPN(I)=SEP(I)
        IF(I.EQ.1) OPN(I)=MAX(SEP(I),0.D0)
        EFF=EFF+OPN(I)**2
      END DO
      EFF=SQRT(EFF)
      OLD=MAX(STATEV(1),ONSET)
      TOP=MAX(OLD,EFF)
      DAM=MIN(FAIL*(TOP-ONSET)/(TOP*(FAIL-ONSET)),1.D0)
      DO I=1,NTENS
        DO J=1,NTENS
          DDSDDE(I,J)=0.D0
          IF(EFF.GT.OLD.AND.EFF.LT.FAIL) DDSDDE(I,J)=-STIFF*OPN(I)
     1      *OPN(J)*FAIL*ONSET/((FAIL-ONSET)*EFF**3)
        END DO
        STRESS(I)=(1.D0-DAM)*STIFF*OPN(I)+STIFF*(SEP(I)-OPN(I))
        IF(I.EQ.1.AND.SEP(I).LT.0.D0) THEN
          DDSDDE(I,I)=STIFF
        ELSE
          DDSDDE(I,I)=DDSDDE(I,I)+(1.D0-DAM)*STIFF
        END IF
      END DO
      SSE=0.D0
      DO I=1,NTENS
        SSE=SSE+0.5D0*STRESS(I)*SEP(I)
      END DO
      SPD=SPD+0.5D0*STIFF*FAIL*ONSET/(FAIL-ONSET)
     1 *(MIN(TOP,FAIL)-MIN(OLD,FAIL))
      STATEV(1)=TOP
      END
